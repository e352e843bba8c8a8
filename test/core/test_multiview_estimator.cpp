#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/multiview_estimator.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
using testing::SceneSettings;
using testing::Surface;
using testing::SyntheticLightField;

SceneSettings crossSettings(int side = 9)
{
  SceneSettings settings;
  settings.positions = testing::crossPositions(side, side);
  return settings;
}

DisparityEstimate estimate(const LightField& light_field, const DisparityRange& range,
                           const MultiviewOptions& options = {}, int threads = 2)
{
  MultiviewEstimator estimator(options);
  ThreadPool pool(threads);
  RunContext context(pool);
  EstimateRequest request;
  request.disparity_range = range;
  return estimator.estimate(light_field, request, context);
}

constexpr DisparityRange STANDARD_RANGE{-1.6F, 2.4F};

SyntheticLightField standardLightField(const SceneSettings& settings)
{
  return testing::renderScene(testing::standardScene(settings.size), settings);
}

TEST(MultiviewEstimator, FindsPlanesEdgesAndCurves)
{
  const auto input = standardLightField(crossSettings());
  const auto result = estimate(input.light_field, STANDARD_RANGE);
  EXPECT_LT(testing::meanAbsoluteError(result.disparity, input.truth), 0.03);
  EXPECT_LT(testing::badPercentage(result.disparity, input.truth, 0.07), 3.5);
  EXPECT_EQ(result.views_used, 17U);
  EXPECT_TRUE(cv::checkRange(result.disparity));
}

TEST(MultiviewEstimator, DoesNotDependOnTheNumberOfThreads)
{
  const auto input = standardLightField(crossSettings(5));
  const auto one = estimate(input.light_field, STANDARD_RANGE, {}, 1);
  for (const int threads : {2, 5})
  {
    const auto many = estimate(input.light_field, STANDARD_RANGE, {}, threads);
    EXPECT_EQ(cv::norm(one.disparity, many.disparity, cv::NORM_INF), 0.0) << threads << " threads";
    EXPECT_EQ(cv::norm(one.confidence, many.confidence, cv::NORM_INF), 0.0) << threads << " threads";
  }
}

TEST(MultiviewEstimator, DoesNotRememberEarlierFrames)
{
  const auto small = standardLightField(crossSettings(3));
  auto settings = crossSettings(5);
  settings.size = {160, 120};
  const auto large = standardLightField(settings);
  MultiviewEstimator estimator;
  ThreadPool pool(2);
  RunContext context(pool);
  EstimateRequest request;
  request.disparity_range = STANDARD_RANGE;
  const auto first = estimator.estimate(small.light_field, request, context);
  static_cast<void>(estimator.estimate(large.light_field, request, context));
  const auto again = estimator.estimate(small.light_field, request, context);
  EXPECT_EQ(cv::norm(first.disparity, again.disparity, cv::NORM_INF), 0.0);
}

struct Array
{
  const char* name;
  std::vector<GridPosition> positions;
  GridPosition reference;
  double bad_percentage;
};

class MultiviewArrays : public ::testing::TestWithParam<Array>
{
};

TEST_P(MultiviewArrays, AreSolved)
{
  SceneSettings settings;
  settings.positions = GetParam().positions;
  settings.reference = GetParam().reference;
  const auto input = standardLightField(settings);
  const auto result = estimate(input.light_field, STANDARD_RANGE);
  EXPECT_LT(testing::badPercentage(result.disparity, input.truth, 0.2), GetParam().bad_percentage);
}

std::vector<GridPosition> without(std::vector<GridPosition> positions,
                                  const std::function<bool(const GridPosition&)>& missing)
{
  positions.erase(std::remove_if(positions.begin(), positions.end(), missing), positions.end());
  return positions;
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, MultiviewArrays,
    ::testing::Values(Array{"full grid", testing::gridPositions(5, 5), {2, 2}, 4.0},
                      Array{"three by three", testing::gridPositions(3, 3), {1, 1}, 5.0},
                      Array{"corner reference", testing::gridPositions(3, 3), {0, 0}, 12.0},
                      Array{"row", testing::gridPositions(1, 9), {0, 4}, 6.0},
                      Array{"column", testing::gridPositions(9, 1), {4, 0}, 6.0},
                      Array{"end of a row", testing::gridPositions(1, 5), {0, 0}, 12.0},
                      Array{"pair", testing::gridPositions(1, 2), {0, 0}, 20.0},
                      Array{"sparse cross",
                            without(testing::crossPositions(9, 9), [](const GridPosition& p)
                                    { return (p.row + p.column) % 3 == 1 && p.row != 4; }),
                            {4, 4},
                            4.0}),
    [](const ::testing::TestParamInfo<Array>& array)
    {
      std::string name = array.param.name;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    });

TEST(MultiviewEstimator, UsesPositionsOffTheGridAndOffsets)
{
  auto settings = crossSettings(5);
  auto input = standardLightField(settings);
  // The same images with another unit of the grid and a shift that the calibration knows.
  for (View& view : input.light_field.views)
  {
    view.steps *= 0.7;
    if (view.steps.x > 1.0)
    {
      const cv::Matx23f shift(1, 0, 3, 0, 1, -2);
      cv::warpAffine(view.image, view.image, shift, view.image.size(), cv::INTER_LINEAR,
                     cv::BORDER_REPLICATE);
      view.offset_px = {3.0, -2.0};
    }
  }
  const auto result = estimate(input.light_field, {-2.4F, 3.5F});
  const cv::Mat unscaled = result.disparity * 0.7;
  EXPECT_LT(testing::badPercentage(unscaled, input.truth, 0.1), 4.0);
}

TEST(MultiviewEstimator, SolvesLargeDisparitiesOfASparseArray)
{
  SceneSettings settings;
  settings.size = {192, 128};
  settings.positions = testing::gridPositions(3, 3);
  const std::vector<Surface> scene = {
      testing::plane(2.0, 0.01, 0.0, testing::noiseTexture(4, 20.0)),
      testing::rectangle(10.0, {60, 30, 60, 70}, testing::noiseTexture(5, 14.0, {150, 110, 90})),
  };
  const auto input = testing::renderScene(scene, settings);
  const auto result = estimate(input.light_field, {1.0F, 11.0F});
  EXPECT_LT(testing::badPercentage(result.disparity, input.truth, 0.3, 12), 4.0);
}

TEST(MultiviewEstimator, NamesOptionsThatCannotBeUsed)
{
  MultiviewOptions options;
  EXPECT_TRUE(validate(options).empty());
  options.label_step_px = 0.0F;
  options.refinements = -1;
  EXPECT_EQ(validate(options).size(), 2U);
  EXPECT_THROW(multiviewPresetFromString("fastest"), InputError);
  EXPECT_EQ(multiviewPresetFromString(toString(MultiviewPreset::Quality)), MultiviewPreset::Quality);
}

}  // namespace
}  // namespace light_field_depth
