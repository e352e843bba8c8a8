#include "core/multiview/refine/linearizer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/synthetic_scene.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr float TRUTH_PX = 0.37F;
constexpr int BORDER_PX = 12;

/// A textured wall with a part without texture on its right.
LightField wall(const std::vector<GridPosition>& positions = testing::crossPositions(5, 5),
                double brightness_per_step = 0.0)
{
  testing::SceneSettings settings;
  settings.size = {128, 80};
  settings.positions = positions;
  if (brightness_per_step != 0.0)
  {
    settings.degrade = [=](const GridPosition& grid, cv::Mat& values)
    { values += cv::Scalar::all(brightness_per_step * (grid.column - 2)); };
  }
  return testing::renderScene({testing::plane(TRUTH_PX, 0.0, 0.0, testing::noiseTexture(3, 10.0)),
                               testing::rectangle(TRUTH_PX + 1e-6, {90.0, 0.0, 60.0, 80.0},
                                                  testing::constantTexture({120, 120, 120}))},
                              settings)
      .light_field;
}

Linearization linearized(const LightField& light_field, float start_px, int threads = 2,
                         const LinearizationSettings& settings = {})
{
  ThreadPool pool(threads);
  ViewSet views;
  ViewSetSettings view_settings;
  view_settings.range = {-1.0F, 2.0F};
  prepareViews(light_field, view_settings, pool, views);
  Linearization result;
  Linearizer linearizer;
  linearizer.run(views, cv::Mat(light_field.size(), CV_32FC1, cv::Scalar(start_px)), {}, settings, pool,
                 result);
  return result;
}

const cv::Rect TEXTURED(BORDER_PX, BORDER_PX, 90 - 2 * BORDER_PX, 80 - 2 * BORDER_PX);
const cv::Rect FLAT(90 + BORDER_PX, BORDER_PX, 38 - 2 * BORDER_PX, 80 - 2 * BORDER_PX);

double meanError(const Linearization& linear)
{
  return cv::norm(linear.target(TEXTURED), cv::Mat(TEXTURED.size(), CV_32FC1, cv::Scalar(TRUTH_PX)),
                  cv::NORM_L1) /
         TEXTURED.area();
}

TEST(Linearizer, TheMinimumIsATenthOfAPixelAway)
{
  for (const float start : {TRUTH_PX - 0.1F, TRUTH_PX, TRUTH_PX + 0.1F})
  {
    EXPECT_LT(meanError(linearized(wall(), start)), 0.02) << start;
  }
}

TEST(Linearizer, NoStepIsLargerThanTheApproximationHolds)
{
  LinearizationSettings settings;
  const Linearization linear = linearized(wall(), TRUTH_PX + 0.5F);
  double least = 0.0;
  double most = 0.0;
  cv::minMaxIdx(linear.target, &least, &most);
  EXPECT_GE(least, TRUTH_PX + 0.5F - settings.max_step_px - 1e-5F);
  EXPECT_LE(most, TRUTH_PX + 0.5F + settings.max_step_px + 1e-5F);
}

TEST(Linearizer, OneChannelOfThreeFindsTheMinimumAsWell)
{
  LinearizationSettings settings;
  settings.one_channel = true;
  const Linearization one = linearized(wall(), TRUTH_PX + 0.1F, 2, settings);
  EXPECT_LT(meanError(one), 0.03);
  const double all = cv::mean(linearized(wall(), TRUTH_PX + 0.1F).weight(TEXTURED))[0];
  EXPECT_NEAR(cv::mean(one.weight(TEXTURED))[0] / all, 1.0, 0.5) << "of the size of three";
}

TEST(Linearizer, TextureHasWeightAndFlatPartsHaveNone)
{
  const Linearization linear = linearized(wall(), TRUTH_PX);
  EXPECT_GT(cv::mean(linear.weight(TEXTURED))[0], 100.0);
  EXPECT_LT(cv::mean(linear.weight(FLAT))[0], 1e-3);
  EXPECT_LT(cv::mean(linear.residual(TEXTURED))[0], 6.0) << "two levels in each channel";
  EXPECT_LT(cv::mean(linear.disagreement(TEXTURED))[0], 0.03);
}

TEST(Linearizer, BrightnessThatChangesWithThePositionIsToldFromDisparity)
{
  LinearizationSettings with;
  with.match_scale = 100.0F;
  LinearizationSettings without = with;
  without.brightness_slope = false;
  // On one side of the reference alone brighter and displaced are easily taken for each other.
  const LightField one_sided = wall({{0, 2}, {0, 3}, {0, 4}}, 4.0);
  const LightField glossy = makeLightField(one_sided.views, GridPosition{0, 2});
  const double error = meanError(linearized(glossy, TRUTH_PX, 2, with));
  EXPECT_LT(error, 0.02);
  EXPECT_GT(meanError(linearized(glossy, TRUTH_PX, 2, without)), 1.5 * error);
}

TEST(Linearizer, IsTheSameOnAnyNumberOfThreads)
{
  const Linearization one = linearized(wall(), 0.3F, 1);
  const Linearization three = linearized(wall(), 0.3F, 3);
  EXPECT_EQ(cv::norm(one.target, three.target, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(one.weight, three.weight, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace light_field_depth::multiview
