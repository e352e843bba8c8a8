#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "core/multiview/multiview_estimator.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/core/noise_estimate.h"
#include "support/named_scenes.h"
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

DisparityEstimate estimate(const LightField& light_field, const std::optional<DisparityRange>& range,
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

TEST(MultiviewEstimator, DoesNotDependOnTheOrderInWhichTheViewsCome)
{
  for (const bool cross : {true, false})
  {
    auto settings = crossSettings(5);
    settings.positions = cross ? testing::crossPositions(5, 5) : testing::gridPositions(3, 3);
    const LightField sorted = standardLightField(settings).light_field;
    std::vector<View> views(sorted.views.rbegin(), sorted.views.rend());
    std::swap(views[1], views[4]);
    const LightField shuffled = makeLightField(views, sorted.reference().grid);
    const auto one = estimate(sorted, std::nullopt);
    const auto other = estimate(shuffled, std::nullopt);
    EXPECT_EQ(cv::norm(one.disparity, other.disparity, cv::NORM_INF), 0.0);
    EXPECT_EQ(cv::norm(one.confidence, other.confidence, cv::NORM_INF), 0.0);
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

/// Percentage of bad pixels among the most confident `kept` of all.
double badAmongMostConfident(const DisparityEstimate& result, const cv::Mat& truth, double kept)
{
  constexpr double threshold_px = 0.07;
  std::vector<std::pair<float, bool>> pixels;
  for (int y = 8; y < truth.rows - 8; ++y)
  {
    for (int x = 8; x < truth.cols - 8; ++x)
    {
      const float error = std::abs(result.disparity.at<float>(y, x) - truth.at<float>(y, x));
      pixels.emplace_back(result.confidence.at<float>(y, x), error > threshold_px);
    }
  }
  std::sort(pixels.begin(), pixels.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  const auto count = static_cast<std::ptrdiff_t>(kept * static_cast<double>(pixels.size()));
  const auto bad =
      std::count_if(pixels.begin(), pixels.begin() + count, [](const auto& p) { return p.second; });
  return 100.0 * static_cast<double>(bad) / static_cast<double>(count);
}

TEST(MultiviewEstimator, KnowsWhereItIsWrong)
{
  const auto input = standardLightField(crossSettings());
  const auto result = estimate(input.light_field, STANDARD_RANGE);
  double low = 0.0;
  double high = 0.0;
  cv::minMaxIdx(result.confidence, &low, &high);
  EXPECT_GE(low, 0.0);
  EXPECT_LE(high, 1.0);
  const double all = badAmongMostConfident(result, input.truth, 1.0);
  const double kept = badAmongMostConfident(result, input.truth, 0.9);
  EXPECT_LT(kept, 0.35 * all);
}

TEST(MultiviewEstimator, DoesNotTrustSurfacesWithoutTexture)
{
  auto settings = crossSettings(5);
  auto scene = testing::standardScene(settings.size);
  scene[0] = testing::plane(-1.0, 0.0, 0.0, testing::constantTexture({90, 90, 90}));
  const auto input = testing::renderScene(scene, settings);
  const auto result = estimate(input.light_field, STANDARD_RANGE);
  const cv::Rect nothing(90, 4, 30, 12);
  const cv::Rect texture(30, 35, 10, 20);
  EXPECT_LT(cv::mean(result.confidence(nothing))[0], 0.05);
  EXPECT_GT(cv::mean(result.confidence(texture))[0], 0.7);
}

TEST(MultiviewEstimator, SolvesMapsOfViewsThatStandFarApart)
{
  auto settings = crossSettings(5);
  const auto scene = testing::standardScene(settings.size);
  const auto input = testing::renderScene(scene, settings);
  MultiviewEstimator estimator;
  ThreadPool pool(2);
  RunContext context(pool);
  EstimateRequest request;
  request.disparity_range = STANDARD_RANGE;
  request.solved_maps = 3;
  const auto result = estimator.estimate(input.light_field, request, context);
  ASSERT_EQ(result.view_disparities.size(), 3U);
  EXPECT_EQ(result.view_disparities[0].view_index, input.light_field.reference_index);
  for (const ViewDisparity& map : result.view_disparities)
  {
    const View& view = input.light_field.views[map.view_index];
    const cv::Mat truth = testing::renderTruth(scene, settings.size, view.steps);
    EXPECT_TRUE(cv::checkRange(map.disparity)) << toString(view.grid);
    EXPECT_LT(testing::badPercentage(map.disparity, truth, 0.1), 8.0) << toString(view.grid);
  }
}

TEST(MultiviewEstimator, MeasuresNoiseAndWithstandsIt)
{
  auto settings = crossSettings();
  for (const double sigma : {0.0, 3.0, 8.0})
  {
    settings.noise_sigma = sigma;
    const auto input = standardLightField(settings);
    const float measured = estimateNoise(input.light_field.reference().image);
    EXPECT_NEAR(measured, sigma, 0.2 * sigma + 1.0);
    const auto result = estimate(input.light_field, STANDARD_RANGE);
    EXPECT_LT(testing::meanAbsoluteError(result.disparity, input.truth), 0.03 + 0.012 * sigma)
        << "sigma " << sigma;
  }
}

TEST(MultiviewEstimator, WithstandsExposureAndVignettingThatDifferFromViewToView)
{
  for (const testing::NamedScene& scene : {testing::exposureDifferences(), testing::vignetting()})
  {
    const auto input = scene.render();
    const auto result = estimate(input.light_field, STANDARD_RANGE);
    EXPECT_LT(testing::meanAbsoluteError(result.disparity, input.truth), 0.025) << scene.name;
    EXPECT_LT(testing::badPercentage(result.disparity, input.truth, 0.1), 2.5) << scene.name;
  }
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
  const auto result = estimate(input.light_field, DisparityRange{-2.4F, 3.5F});
  const cv::Mat unscaled = result.disparity * 0.7;
  EXPECT_LT(testing::badPercentage(unscaled, input.truth, 0.1), 4.0);
}

TEST(MultiviewEstimator, UsesTheTruePlacesOfViewsThatAreAFifthOffTheGrid)
{
  // Rendered on a grid that is five times as fine.
  constexpr int FINE = 5;
  const int off[] = {0, 1, -1, 1, 0, -1, 1, -1, 0, 1, -1, 1, 0};
  SceneSettings settings;
  settings.size = {160, 128};
  const std::vector<GridPosition> grid = testing::crossPositions(7, 7);
  for (std::size_t i = 0; i < grid.size(); ++i)
  {
    const bool is_reference = grid[i] == GridPosition{3, 3};
    settings.positions.push_back({FINE * grid[i].row + (is_reference ? 0 : off[i]),
                                  FINE * grid[i].column + (is_reference ? 0 : off[(i + 5) % grid.size()])});
  }
  settings.reference = GridPosition{3 * FINE, 3 * FINE};
  const auto texture = [](std::uint32_t seed) { return testing::noiseTexture(seed, 16.0); };
  auto input = testing::renderScene(
      {testing::plane(0.6, 0.001, 0.0, texture(3)), testing::rectangle(1.1, {50, 40, 60, 50}, texture(4))},
      settings);
  for (std::size_t i = 0; i < grid.size(); ++i)
  {
    View& view = input.light_field.views[i];
    view.steps = {view.steps.x / FINE, view.steps.y / FINE};
    view.grid = grid[i];
  }
  const auto result = estimate(input.light_field, DisparityRange{2.0F, 6.5F});
  const cv::Mat in_fine_steps = result.disparity / FINE;
  EXPECT_LT(testing::badPercentage(in_fine_steps, input.truth, 0.05 / FINE), 4.0)
      << "with the places of the grid it is 16";
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
  const auto result = estimate(input.light_field, DisparityRange{1.0F, 11.0F});
  EXPECT_LT(testing::badPercentage(result.disparity, input.truth, 0.3, 12), 4.0);
}

TEST(MultiviewEstimator, FindsTheRangeOfFewViewsWithEveryPreset)
{
  SceneSettings settings;
  settings.size = {288, 224};
  settings.positions = testing::gridPositions(3, 3);
  const std::vector<Surface> scene = {
      testing::plane(5.0, 0.0, 0.0, testing::noiseTexture(4, 20.0)),
      testing::rectangle(5.0, {200, 0, 88, 224}, testing::stripeTexture(8.0, true)),
      testing::rectangle(10.0, {60, 50, 80, 90}, testing::noiseTexture(5, 14.0, {150, 110, 90})),
  };
  const auto input = testing::renderScene(scene, settings);
  for (const auto preset : {MultiviewPreset::Balanced, MultiviewPreset::Realtime, MultiviewPreset::Fast})
  {
    ThreadPool pool(2);
    RunContext context(pool);
    MultiviewOptions options;
    options.preset = preset;
    const auto result = MultiviewEstimator(options).estimate(input.light_field, {}, context);
    EXPECT_GT(result.range.min, 2.0F) << toString(preset);
    EXPECT_LT(result.range.max, 13.0F) << toString(preset);
    EXPECT_LT(testing::badPercentage(result.disparity, input.truth, 1.0, 12), 6.0) << toString(preset);
  }
}

TEST(MultiviewEstimator, NamesOptionsThatCannotBeUsed)
{
  MultiviewOptions options;
  EXPECT_TRUE(validate(options).empty());
  options.label_step_px = 0.0F;
  options.refinements = -2;
  EXPECT_EQ(validate(options).size(), 2U);
  EXPECT_THROW(multiviewPresetFromString("fastest"), InputError);
  EXPECT_EQ(multiviewPresetFromString(toString(MultiviewPreset::Quality)), MultiviewPreset::Quality);
}

TEST(MultiviewEstimator, ALargeLightFieldIsSolvedCoarseToFine)
{
  testing::SceneSettings settings;
  settings.size = {1040, 1000};
  settings.positions = testing::crossPositions(5, 5);
  settings.samples = 1;
  const auto scene = testing::renderScene(
      {testing::plane(-0.8, 0.0004, -0.0003, testing::noiseTexture(4, 16.0)),
       testing::rectangle(1.9, {400.0, 380.0, 300.0, 250.0}, testing::noiseTexture(9, 12.0))},
      settings);
  DisparityEstimate first;
  for (const int threads : {1, 2})
  {
    ThreadPool pool(threads);
    RunContext context(pool);
    MultiviewEstimator estimator;
    const DisparityEstimate estimate = estimator.estimate(scene.light_field, {}, context);
    EXPECT_LT(testing::meanAbsoluteError(estimate.disparity, scene.truth), 0.02);
    if (first.disparity.empty())
    {
      first = estimate;
      continue;
    }
    EXPECT_EQ(cv::norm(first.disparity, estimate.disparity, cv::NORM_INF), 0.0);
    EXPECT_EQ(cv::norm(first.confidence, estimate.confidence, cv::NORM_INF), 0.0);
  }
}

/// Noise leaves the refinement without data, stripes without links: its equations are nearly singular.
TEST(MultiviewEstimator, IsFiniteWhereNothingIsKnown)
{
  const DisparityRange range{-1.0F, 1.0F};
  for (const bool striped : {false, true})
  {
    LightField light_field = standardLightField(crossSettings()).light_field;
    cv::RNG random(7);
    for (View& view : light_field.views)
    {
      cv::Mat image(view.image.size(), CV_8UC3, cv::Scalar::all(128));
      for (int y = 0; striped && y < image.rows; y += 2)
      {
        image.row(y).setTo(cv::Scalar::all(40));
      }
      cv::Mat noise(image.size(), CV_16SC3);
      random.fill(noise, cv::RNG::NORMAL, 0, striped ? 15 : 40);
      cv::add(image, noise, view.image, cv::noArray(), CV_8U);
    }
    const auto result = estimate(light_field, range);
    EXPECT_TRUE(cv::checkRange(result.disparity, true, nullptr, -2.5, 2.5)) << "striped: " << striped;
    EXPECT_TRUE(cv::checkRange(result.confidence, true, nullptr, 0.0, 1.0001)) << "striped: " << striped;
  }
}

}  // namespace
}  // namespace light_field_depth
