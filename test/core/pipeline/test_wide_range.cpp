// Views of 16 bits that use little of them, or have pixels that belong to nothing.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>

#include "light_field_depth/core/pipeline.h"
#include "support/benchmark_scenes.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
constexpr double MAX_BAD_PERCENT = 2.0;

/// BadPix 0.07 of the cross of cotton in grey, its levels of 8 bits spread from `darkest` to `brightest`.
double badPercent(const testing::BenchmarkScene& scene, double darkest, double brightest,
                  const std::function<void(std::size_t view, cv::Mat& image)>& spoil)
{
  LightField light_field = selectViews(scene.light_field, ViewSelection::Cross);
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    cv::Mat deep;
    toGrey(light_field.views[i].image).convertTo(deep, CV_16U, (brightest - darkest) / 255.0, darkest);
    spoil(i, deep);
    light_field.views[i].image = deep;
  }
  Pipeline pipeline(2);
  const cv::Mat disparity = pipeline.run(light_field, {}, {}).estimate.disparity;
  return testing::badPercentage(disparity, scene.truth, 0.07, 15);
}

TEST(WideRange, AThermalRangeAndAHotPixelCostNothing)
{
  const auto scene = testing::readBenchmarkScene("cotton");
  if (!scene)
  {
    GTEST_SKIP() << "no benchmark scenes";
  }
  EXPECT_LT(badPercent(*scene, 51241.0, 52181.0, [](std::size_t, cv::Mat&) {}), MAX_BAD_PERCENT);
  const auto hot = [](std::size_t view, cv::Mat& image)
  { image.at<std::uint16_t>(100, 200) = view == 8 ? 65535 : image.at<std::uint16_t>(100, 200); };
  EXPECT_LT(badPercent(*scene, 0.0, 1023.0, hot), MAX_BAD_PERCENT);
}

}  // namespace
}  // namespace light_field_depth
