#include "core/preprocess/exposure_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "support/instruction_sets.h"

namespace light_field_depth
{
namespace
{
/// Noise on steps, some of them black or white.
cv::Mat unevenImage(const cv::Size& size, int type)
{
  cv::Mat image(size, type);
  cv::RNG random(7);
  random.fill(image, cv::RNG::UNIFORM, 0, 60);
  image.colRange(size.width / 2, size.width) += cv::Scalar(190, 150, 120);
  return image;
}

/// Smaller than vectors, and larger but not a multiple of one.
const std::vector<cv::Size> SIZES = {{16, 17}, {131, 40}};

class ExposureViews : public testing::InstructionSetTest
{
};

TEST_P(ExposureViews, AreSmoothedAsByAGaussianKernel)
{
  for (const cv::Size& size : SIZES)
  {
    for (const int type : {CV_8UC1, CV_8UC3})
    {
      const cv::Mat image = unevenImage(size, type);
      cv::Mat expected;
      cv::GaussianBlur(image, expected, cv::Size(5, 5), 0.0);
      EXPECT_EQ(cv::norm(lowPass(image), expected, cv::NORM_INF), 0.0) << size << ", type " << type;
    }
  }
}

TEST_P(ExposureViews, TellWhereValuesAreCutOff)
{
  for (const cv::Size& size : SIZES)
  {
    for (const int type : {CV_8UC1, CV_8UC3})
    {
      const cv::Mat image = unevenImage(size, type);
      cv::Mat darkest;
      cv::Mat brightest;
      cv::erode(image, darkest, cv::Mat::ones(3, 3, CV_8U));
      cv::dilate(image, brightest, cv::Mat::ones(3, 3, CV_8U));
      const cv::Mat expected = (darkest < 5.0) | (brightest > 240.0);
      EXPECT_GT(cv::countNonZero(expected.reshape(1)), 0);
      EXPECT_LT(cv::countNonZero(expected.reshape(1)), static_cast<int>(expected.reshape(1).total()));
      const cv::Mat found = cutOffValues(image) > 0.0;
      EXPECT_EQ(cv::norm(found, expected, cv::NORM_INF), 0.0) << size << ", type " << type;
    }
  }
}

TEST_P(ExposureViews, AreMadeAlikeInMeanAndContrast)
{
  constexpr int WINDOW_SIDE = 9;
  for (const cv::Size& size : SIZES)
  {
    const cv::Mat image = unevenImage(size, CV_8UC1);
    cv::Mat_<double> deviation;
    cv::Mat mean;
    image.convertTo(deviation, CV_64F);
    cv::blur(deviation, mean, cv::Size(WINDOW_SIDE, WINDOW_SIDE));
    deviation -= mean;
    cv::Mat_<double> square;
    cv::blur(deviation.mul(deviation), square, cv::Size(WINDOW_SIDE, WINDOW_SIDE));
    const cv::Mat normalized = normalizeLocally(image);
    for (int y = 0; y < size.height; ++y)
    {
      for (int x = 0; x < size.width; ++x)
      {
        const double expected = 128.0 + 40.0 * deviation(y, x) / (std::sqrt(square(y, x)) + 4.0);
        ASSERT_NEAR(normalized.at<std::uint8_t>(y, x), std::clamp(expected, 0.0, 255.0), 0.501)
            << size << ", " << x << ", " << y;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, ExposureViews, testing::everyInstructionSet(),
                         testing::instructionSetName);

}  // namespace
}  // namespace light_field_depth
