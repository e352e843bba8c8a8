#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/multiview_estimator.h"
#include "support/synthetic_scene.h"

namespace light_field_depth::multiview
{
namespace
{
DisparityEstimate estimateFast(const LightField& light_field, int threads)
{
  MultiviewOptions options;
  options.preset = MultiviewPreset::Fast;
  MultiviewEstimator estimator(options);
  ThreadPool pool(threads);
  RunContext context(pool);
  return estimator.estimate(light_field, {}, context);
}

TEST(FastPreset, SolvesTheStandardSceneInPixelsOfTheFullResolution)
{
  testing::SceneSettings settings;
  settings.positions = testing::crossPositions(9, 9);
  settings.size = {255, 192};
  const auto input = testing::renderScene(testing::standardScene(settings.size), settings);
  const auto one = estimateFast(input.light_field, 1);
  EXPECT_EQ(one.disparity.size(), settings.size);
  EXPECT_EQ(one.confidence.size(), settings.size);
  EXPECT_TRUE(cv::checkRange(one.disparity));
  EXPECT_LT(testing::meanAbsoluteError(one.disparity, input.truth), 0.06);
  EXPECT_LT(testing::badPercentage(one.disparity, input.truth, 0.2), 4.0);
  const auto many = estimateFast(input.light_field, 3);
  EXPECT_EQ(cv::norm(one.disparity, many.disparity, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(one.confidence, many.confidence, cv::NORM_INF), 0.0);
}

TEST(FastPreset, TakesTheSmallestViews)
{
  testing::SceneSettings settings;
  settings.positions = testing::crossPositions(3, 3);
  for (const int side : {16, 33})
  {
    settings.size = {side, side};
    const auto input = testing::renderScene(testing::standardScene(settings.size), settings);
    const auto result = estimateFast(input.light_field, 2);
    EXPECT_EQ(result.disparity.size(), settings.size);
    EXPECT_TRUE(cv::checkRange(result.disparity));
  }
}

TEST(FastPreset, MakesUpForExposureThatDiffers)
{
  testing::SceneSettings settings;
  settings.positions = testing::crossPositions(5, 5);
  settings.size = {256, 192};
  const auto even = testing::renderScene(testing::standardScene(settings.size), settings);
  settings.degrade = [](const GridPosition& position, cv::Mat& values)
  { values *= 1.0 + 0.04 * (position.column - 2); };
  const auto uneven = testing::renderScene(testing::standardScene(settings.size), settings);
  const double bad_even =
      testing::badPercentage(estimateFast(even.light_field, 2).disparity, even.truth, 0.2);
  const double bad_uneven =
      testing::badPercentage(estimateFast(uneven.light_field, 2).disparity, uneven.truth, 0.2);
  EXPECT_LT(bad_uneven, 1.5 * bad_even + 1.0);
}

}  // namespace
}  // namespace light_field_depth::multiview
