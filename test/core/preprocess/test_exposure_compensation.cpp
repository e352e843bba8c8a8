#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "light_field_depth/core/exposure.h"

namespace light_field_depth
{
namespace
{
LightField twoViews(int type)
{
  cv::Mat image(24, 37, type);
  cv::RNG random(3);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return makeLightField({gridView(0, 0, image), gridView(0, 1, image.clone())}, GridPosition{0, 0});
}

/// By the formula of ViewExposure.
double expected(const ViewExposure& exposure, const cv::Mat& image, int x, int y, int channel)
{
  const double value = image.ptr<std::uint8_t>(y)[x * image.channels() + channel];
  const double half_diagonal = 0.5 * std::hypot(image.cols, image.rows);
  const double u = (x - 0.5 * (image.cols - 1)) / half_diagonal;
  const double v = (y - 0.5 * (image.rows - 1)) / half_diagonal;
  const double shading = 1.0 + exposure.shading.dot(cv::Vec3d(u, v, u * u + v * v));
  return exposure.gain[channel] * shading * value + exposure.offset[channel] +
         exposure.bend[channel] * value * value / 255.0;
}

void expectFormula(const ViewExposure& exposure, int type)
{
  const LightField field = twoViews(type);
  ThreadPool pool(2);
  const LightField result = compensateExposure(field, {ViewExposure{}, exposure}, pool);
  EXPECT_EQ(result.views[0].image.data, field.views[0].image.data) << "a view that does not differ is shared";
  const cv::Mat& before = field.views[1].image;
  const cv::Mat& after = result.views[1].image;
  ASSERT_NE(after.data, before.data);
  for (int y = 0; y < before.rows; ++y)
  {
    for (int x = 0; x < before.cols; ++x)
    {
      for (int channel = 0; channel < before.channels(); ++channel)
      {
        const double value = std::clamp(expected(exposure, before, x, y, channel), 0.0, 255.0);
        ASSERT_NEAR(after.ptr<std::uint8_t>(y)[x * before.channels() + channel], value, 0.501)
            << x << " " << y << " " << channel;
      }
    }
  }
}

TEST(ExposureCompensation, FollowsItsFormulaInGreyAndColour)
{
  ViewExposure exposure;
  exposure.differs = true;
  exposure.gain = {1.3, 0.8, 1.1};
  exposure.offset = {-9.0, 5.0, 2.5};
  exposure.shading = {0.1, -0.2, 0.25};
  expectFormula(exposure, CV_8UC1);
  expectFormula(exposure, CV_8UC3);
}

TEST(ExposureCompensation, FollowsItsFormulaWithABend)
{
  ViewExposure exposure;
  exposure.differs = true;
  exposure.gain = {1.3, 1.2, 0.7};
  exposure.offset = {-4.0, 5.0, 2.5};
  exposure.bend = {-0.3, -0.2, 0.3};
  exposure.shading = {0.1, -0.2, 0.25};
  expectFormula(exposure, CV_8UC1);
  expectFormula(exposure, CV_8UC3);
}

}  // namespace
}  // namespace light_field_depth
