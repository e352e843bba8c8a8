#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "core/paper2017/paper2017_estimator.h"
#include "light_field_depth/core/error.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
using testing::SceneSettings;

SceneSettings settingsOf(std::vector<GridPosition> positions)
{
  SceneSettings settings;
  settings.size = {160, 128};
  settings.positions = std::move(positions);
  return settings;
}

testing::SyntheticLightField standardInput(const SceneSettings& settings)
{
  return testing::renderScene(testing::standardScene(settings.size), settings);
}

DisparityEstimate estimate(const LightField& light_field, const Paper2017Options& options = {},
                           const EstimateRequest& request = {}, int threads = 2)
{
  ThreadPool pool(threads);
  RunContext context(pool);
  return Paper2017Estimator(options).estimate(light_field, request, context);
}

double badOf(const SceneSettings& settings, double threshold_px, const Paper2017Options& options = {})
{
  const auto input = standardInput(settings);
  return testing::badPercentage(estimate(input.light_field, options).disparity, input.truth, threshold_px);
}

bool identical(const cv::Mat& a, const cv::Mat& b)
{
  return cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(Paper2017, FindsTheStandardSceneFromACross)
{
  const auto input = standardInput(settingsOf(testing::crossPositions(7, 7)));
  const DisparityEstimate result = estimate(input.light_field);
  EXPECT_LT(testing::badPercentage(result.disparity, input.truth, 0.07), 14.0);
  EXPECT_LT(testing::badPercentage(result.disparity, input.truth, 0.3), 5.0);
  EXPECT_EQ(result.views_used, 13U);
  EXPECT_NEAR(result.range.min, -1.2F, 0.2F);
  EXPECT_NEAR(result.range.max, 2.0F, 0.2F);
}

TEST(Paper2017, TakesRowsColumnsPairsAndSparseGrids)
{
  EXPECT_LT(badOf(settingsOf(testing::gridPositions(1, 7)), 0.3), 9.0);
  EXPECT_LT(badOf(settingsOf(testing::gridPositions(7, 1)), 0.3), 9.0);
  EXPECT_LT(badOf(settingsOf({{0, 0}, {0, 1}}), 0.3), 20.0);
  EXPECT_LT(badOf(settingsOf({{0, 0}, {0, 4}, {0, 8}, {4, 0}, {4, 4}, {4, 8}, {8, 0}, {8, 4}, {8, 8}}), 0.3),
            10.0);
  EXPECT_LT(badOf(settingsOf({{0, 0}, {1, 2}, {3, 1}}), 0.3), 20.0);
}

TEST(Paper2017, TakesAReferenceOffTheMiddle)
{
  SceneSettings settings = settingsOf(testing::crossPositions(5, 5));
  settings.reference = GridPosition{2, 0};
  EXPECT_LT(badOf(settings, 0.3), 10.0);
}

TEST(Paper2017, TakesGreyAndSixteenBits)
{
  SceneSettings settings = settingsOf(testing::crossPositions(5, 5));
  settings.grey = true;
  EXPECT_LT(badOf(settings, 0.3), 9.0);
  settings.grey = false;
  auto input = standardInput(settings);
  const cv::Mat eight_bit = estimate(input.light_field).disparity;
  for (View& view : input.light_field.views)
  {
    cv::Mat wide;
    view.image.convertTo(wide, CV_16U, 257.0);
    view.image = wide;
  }
  EXPECT_TRUE(identical(estimate(input.light_field).disparity, eight_bit));
}

TEST(Paper2017, BearsNoiseAndExposure)
{
  SceneSettings settings = settingsOf(testing::crossPositions(7, 7));
  settings.noise_sigma = 4.0;
  settings.degrade = [](const GridPosition& grid, cv::Mat& values) { values *= 0.9 + 0.03 * grid.column; };
  EXPECT_LT(badOf(settings, 0.3), 10.0);
}

TEST(Paper2017, DoesNotDependOnThreadsOrEarlierRuns)
{
  const auto input = standardInput(settingsOf(testing::crossPositions(5, 5)));
  EstimateRequest request;
  request.solved_maps = 9;
  const DisparityEstimate one = estimate(input.light_field, {}, request, 1);
  ThreadPool pool(3);
  RunContext context(pool);
  Paper2017Estimator estimator;
  estimator.estimate(input.light_field, {}, context);
  const DisparityEstimate three = estimator.estimate(input.light_field, request, context);
  EXPECT_TRUE(identical(one.disparity, three.disparity));
  EXPECT_TRUE(identical(one.confidence, three.confidence));
  ASSERT_EQ(one.view_disparities.size(), three.view_disparities.size());
  EXPECT_TRUE(identical(one.view_disparities.back().disparity, three.view_disparities.back().disparity));
}

TEST(Paper2017, GivesAMapForEveryViewInItsOwnPixels)
{
  const SceneSettings settings = settingsOf(testing::crossPositions(5, 5));
  const auto input = standardInput(settings);
  EstimateRequest request;
  request.solved_maps = 9;
  const DisparityEstimate result = estimate(input.light_field, {}, request);
  ASSERT_EQ(result.view_disparities.size(), 9U);
  std::set<std::size_t> seen;
  for (const ViewDisparity& map : result.view_disparities)
  {
    seen.insert(map.view_index);
    EXPECT_TRUE(cv::checkRange(map.disparity));
    const cv::Mat truth = testing::renderTruth(testing::standardScene(settings.size), settings.size,
                                               input.light_field.views[map.view_index].steps);
    EXPECT_LT(testing::badPercentage(map.disparity, truth, 0.3), 15.0) << map.view_index;
  }
  EXPECT_EQ(seen.size(), 9U);
}

TEST(Paper2017, IsLessConfidentWhereItIsWrong)
{
  const auto input = standardInput(settingsOf(testing::crossPositions(7, 7)));
  const DisparityEstimate result = estimate(input.light_field);
  const cv::Mat error = cv::abs(result.disparity - input.truth);
  const double of_wrong = cv::mean(result.confidence, error > 0.3)[0];
  const double of_right = cv::mean(result.confidence, error < 0.07)[0];
  EXPECT_LT(of_wrong, 0.6 * of_right);
  double least = 0.0;
  double most = 0.0;
  cv::minMaxIdx(result.confidence, &least, &most);
  EXPECT_GE(least, 0.0);
  EXPECT_LE(most, 1.0);
}

TEST(Paper2017, NamesWhatItKnowsNothingAbout)
{
  for (const cv::Size size : {cv::Size(16, 16), cv::Size(64, 48)})
  {
    SceneSettings settings = settingsOf(testing::crossPositions(3, 3));
    settings.size = size;
    const auto input =
        testing::renderScene({testing::plane(0, 0, 0, testing::constantTexture({60, 70, 80}))}, settings);
    const DisparityEstimate result = estimate(input.light_field);
    EXPECT_TRUE(cv::checkRange(result.disparity));
    EXPECT_EQ(cv::countNonZero(result.confidence), 0);
    EXPECT_LT(result.range.min, result.range.max);
  }
}

TEST(Paper2017, TakesTheSmallestImages)
{
  SceneSettings settings = settingsOf(testing::crossPositions(3, 3));
  settings.size = {16, 16};
  const auto input =
      testing::renderScene({testing::plane(0.5, 0, 0, testing::noiseTexture(8, 6.0))}, settings);
  EXPECT_LT(testing::meanAbsoluteError(estimate(input.light_field).disparity, input.truth, 4), 0.2);
}

TEST(Paper2017, TheVariationalStepSharpensTheDisparity)
{
  SceneSettings settings = settingsOf(testing::crossPositions(7, 7));
  settings.noise_sigma = 2.0;
  Paper2017Options options;
  options.variational.enabled = false;
  EXPECT_LT(badOf(settings, 0.07), 0.8 * badOf(settings, 0.07, options));
}

TEST(Paper2017, WeighingByTheCentreKeepsDisparityFromSpreading)
{
  const SceneSettings settings = settingsOf(testing::crossPositions(5, 5));
  const auto input = testing::renderScene(
      {testing::plane(-1.0, 0.0, 0.0, testing::noiseTexture(1, 24.0, {60, 60, 60}, 20.0F)),
       testing::rectangle(1.5, {50, 40, 50, 45}, testing::noiseTexture(2, 12.0, {170, 170, 170}))},
      settings);
  Paper2017Options options;
  options.patch_match.weigh_by_centre = false;
  const double without =
      testing::badPercentage(estimate(input.light_field, options).disparity, input.truth, 0.3);
  const double with = testing::badPercentage(estimate(input.light_field).disparity, input.truth, 0.3);
  EXPECT_LT(with, 0.9 * without);
}

TEST(Paper2017, TakesDisAsInitializer)
{
  Paper2017Options options;
  options.initializer = FlowInitializer::Dis;
  EXPECT_LT(badOf(settingsOf(testing::crossPositions(5, 5)), 0.3, options), 12.0);
}

TEST(Paper2017, TakesTheNumbersOfThePaperInPlaceOfItsOwn)
{
  const auto input = standardInput(settingsOf(testing::crossPositions(3, 3)));
  Paper2017Options published;
  published.parameters = Paper2017Parameters::Published;
  published.feature_flow.sigma_range = 3.0;
  const Paper2017Options same = withPublishedParameters(published);
  EXPECT_EQ(same.feature_flow.sigma_range, 0.4);
  EXPECT_FALSE(same.patch_match.subpixel);
  const cv::Mat disparity = estimate(input.light_field, published).disparity;
  EXPECT_EQ(cv::norm(disparity, estimate(input.light_field, same).disparity, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(disparity, estimate(input.light_field).disparity, cv::NORM_INF), 0.0);
}

TEST(Paper2017, SavesItsIntermediateResults)
{
  const auto input = standardInput(settingsOf(testing::crossPositions(3, 3)));
  ThreadPool pool(2);
  RunContext context(pool);
  std::set<std::string> names;
  context.save_intermediate = [&](const std::string& name, const cv::Mat& values)
  {
    EXPECT_EQ(values.size(), input.truth.size());
    names.insert(name);
  };
  Paper2017Estimator().estimate(input.light_field, {}, context);
  EXPECT_TRUE(names.count("matches_row_1_view_0"));
  EXPECT_TRUE(names.count("feature_flow_column_1_view_2"));
  EXPECT_TRUE(names.count("median"));
  std::vector<std::string> stages;
  for (const StageTime& time : context.stage_times)
  {
    stages.push_back(time.stage);
  }
  EXPECT_EQ(stages,
            (std::vector<std::string>{"descriptors", "matching", "feature_flow", "fusion", "variational"}));
}

TEST(Paper2017, StopsWhenItIsCancelled)
{
  const auto input = standardInput(settingsOf(testing::crossPositions(3, 3)));
  CancellationToken token;
  token.cancel();
  ThreadPool pool(2);
  pool.setCancellation(&token);
  RunContext context(pool);
  EXPECT_THROW(Paper2017Estimator().estimate(input.light_field, {}, context), Cancelled);
}

TEST(Paper2017, NamesItsChoices)
{
  EXPECT_EQ(flowInitializerFromString(toString(FlowInitializer::Dis)), FlowInitializer::Dis);
  EXPECT_EQ(matchDirectionsFromString(toString(MatchDirections::Both)), MatchDirections::Both);
  EXPECT_THROW(flowInitializerFromString("sift"), InputError);
  EXPECT_EQ(paper2017ParametersFromString("published"), Paper2017Parameters::Published);
  EXPECT_THROW(paper2017ParametersFromString("best"), InputError);
  Paper2017Options options;
  EXPECT_TRUE(validate(options).empty());
  options.volumes.rows = "a";
  options.patch_match.levels = 0;
  options.feature_flow.iterations = 0;
  options.variational.sor_omega = 2.5;
  EXPECT_EQ(validate(options).size(), 4U);
}

}  // namespace
}  // namespace light_field_depth
