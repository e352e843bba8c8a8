#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "core/paper2017/patch_match.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
using testing::SceneSettings;
using testing::Surface;

struct Matched
{
  SparseDisparity forward;
  cv::Mat truth;
};

std::vector<Surface> wall(double disparity, double slope_x = 0.0)
{
  return {testing::plane(disparity, slope_x, 0.0, testing::noiseTexture(5, 20.0))};
}

SceneSettings pairSettings(int rows, int columns)
{
  SceneSettings settings;
  settings.size = {160, 128};
  settings.positions = {{0, 0}, {rows, columns}};
  settings.reference = GridPosition{0, 0};
  settings.samples = 1;
  return settings;
}

Matched match(const std::vector<Surface>& scene, const SceneSettings& settings,
              const PatchMatchOptions& options = {},
              const std::optional<DisparityRange>& range = std::nullopt)
{
  const auto input = testing::renderScene(scene, settings);
  const View& a = input.light_field.views[0];
  const View& b = input.light_field.views[1];
  const int levels = usablePyramidLevels(settings.size, options.levels, options.pyramid_ratio);
  const auto from = descriptorPyramid(a.image, levels, options.pyramid_ratio);
  const auto to = descriptorPyramid(b.image, levels, options.pyramid_ratio);
  const SeedMatches there = matchPair(from, to, pairOf(a, b), range, options);
  const SeedMatches back = matchPair(to, from, pairOf(b, a), range, options);
  return {consistentMatches(there, back, pairOf(a, b), settings.size, options), input.truth};
}

double coverage(const SparseDisparity& sparse)
{
  return static_cast<double>(cv::countNonZero(sparse.confidence)) /
         static_cast<double>(sparse.confidence.total());
}

/// Mean and mean absolute error of the matched pixels.
std::pair<double, double> errors(const Matched& matched)
{
  double sum = 0.0;
  double sum_abs = 0.0;
  int count = 0;
  for (int y = 8; y < matched.truth.rows - 8; ++y)
  {
    for (int x = 8; x < matched.truth.cols - 8; ++x)
    {
      if (matched.forward.confidence.at<float>(y, x) > 0.0F)
      {
        const double error = matched.forward.disparity.at<float>(y, x) - matched.truth.at<float>(y, x);
        sum += error;
        sum_abs += std::abs(error);
        ++count;
      }
    }
  }
  return {sum / count, sum_abs / count};
}

TEST(PatchMatch, FindsTheSignOfTheDisparityOnBothAxes)
{
  for (const double disparity : {-3.0, 2.0})
  {
    for (const GridPosition step : {GridPosition{0, 1}, GridPosition{1, 0}})
    {
      const Matched matched = match(wall(disparity), pairSettings(step.row, step.column));
      EXPECT_GT(coverage(matched.forward), 0.85);
      EXPECT_LT(errors(matched).second, 0.05) << disparity << " " << step.row;
    }
  }
}

TEST(PatchMatch, FindsLargeDisparityWithoutARange)
{
  SceneSettings settings = pairSettings(0, 1);
  settings.size = {256, 192};
  const Matched matched = match(wall(33.0), settings);
  EXPECT_GT(coverage(matched.forward), 0.6);
  EXPECT_LT(errors(matched).second, 0.1);
}

TEST(PatchMatch, CountsDisparityForOneGridStepWhereViewsAreMissing)
{
  const Matched matched = match(wall(1.25), pairSettings(0, 4));
  EXPECT_GT(coverage(matched.forward), 0.8);
  EXPECT_LT(errors(matched).second, 0.03);
}

TEST(PatchMatch, FollowsObliqueEpipolarLines)
{
  const Matched matched = match(wall(3.0), pairSettings(1, 3));
  EXPECT_GT(coverage(matched.forward), 0.7);
  EXPECT_LT(errors(matched).second, 0.05);
}

TEST(PatchMatch, FitsBetweenWholePixels)
{
  for (const double disparity : {0.25, 0.5, 0.7, -1.4})
  {
    const auto [bias, spread] = errors(match(wall(disparity), pairSettings(0, 1)));
    EXPECT_LT(std::abs(bias), 0.03) << disparity;
    EXPECT_LT(spread, 0.12) << disparity;
  }
  PatchMatchOptions whole;
  whole.subpixel = false;
  const Matched matched = match(wall(0.7), pairSettings(0, 1), whole);
  EXPECT_FLOAT_EQ(std::round(matched.forward.disparity.at<float>(60, 60)),
                  matched.forward.disparity.at<float>(60, 60));
}

TEST(PatchMatch, DropsWhatTheOtherViewDoesNotSee)
{
  SceneSettings settings = pairSettings(0, 1);
  std::vector<Surface> scene = wall(-2.0);
  scene.push_back(testing::rectangle(6.0, {50, 30, 50, 60}, testing::noiseTexture(9, 12.0)));
  const Matched matched = match(scene, settings);
  // The object moves 8 px to the left over the background, which loses what is left of x = 50.
  int hidden = 0;
  for (int y = 36; y < 84; ++y)
  {
    hidden += matched.forward.confidence.at<float>(y, 46) > 0.3F ? 1 : 0;
  }
  EXPECT_LT(hidden, 10);
  EXPECT_NEAR(matched.forward.disparity.at<float>(60, 75), 6.0F, 0.1F);
  EXPECT_NEAR(matched.forward.disparity.at<float>(60, 120), -2.0F, 0.1F);
}

TEST(PatchMatch, StaysInsideTheGivenRange)
{
  const Matched matched = match(wall(5.0), pairSettings(0, 1), {}, DisparityRange{-1.0F, 2.0F});
  double most = 0.0;
  cv::minMaxIdx(matched.forward.disparity, nullptr, &most);
  EXPECT_LE(most, 2.51);
}

TEST(PatchMatch, HasNoMatchesOnImagesWithoutTexture)
{
  SceneSettings settings = pairSettings(0, 1);
  const Matched matched =
      match({testing::plane(0.0, 0.0, 0.0, testing::constantTexture({90, 90, 90}))}, settings);
  EXPECT_EQ(cv::countNonZero(matched.forward.confidence), 0);
}

TEST(PatchMatch, BearsNoise)
{
  SceneSettings settings = pairSettings(0, 1);
  settings.noise_sigma = 5.0;
  const Matched matched = match(wall(1.5), settings);
  EXPECT_GT(coverage(matched.forward), 0.8);
  EXPECT_LT(errors(matched).second, 0.15);
}

}  // namespace
}  // namespace light_field_depth
