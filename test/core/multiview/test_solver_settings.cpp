#include "core/multiview/solver_settings.h"

#include <gtest/gtest.h>

namespace light_field_depth::multiview
{
namespace
{
LightField row(int views)
{
  std::vector<View> of_row;
  for (int column = 0; column < views; ++column)
  {
    of_row.push_back(gridView(0, column, cv::Mat(32, 48, CV_8UC3, cv::Scalar(0, 0, 0))));
  }
  return makeLightField(of_row);
}

TEST(SolverSettings, TheOutermostViewStandsFourStepsAway)
{
  EXPECT_DOUBLE_EQ(solverUnit(row(9)), 1.0);
  EXPECT_DOUBLE_EQ(solverUnit(row(17)), 2.0);
  EXPECT_DOUBLE_EQ(solverUnit(row(3)), 0.25);
  EXPECT_EQ(inSolverUnit(row(17), 2.0).views.back().steps, cv::Point2d(4, 0));
}

TEST(SolverSettings, TheRangeIsInTheUnitOfTheSolver)
{
  SceneMeasures measures;
  measures.range = {-1.0F, 3.0F};
  const SolverSettings settings = solverSettings({}, measures, row(3), 0.25);
  EXPECT_FLOAT_EQ(settings.range.min, -0.25F);
  EXPECT_FLOAT_EQ(settings.range.max, 0.75F);
}

TEST(SolverSettings, PresetsChooseColourLabelsAndRepetitions)
{
  SceneMeasures measures;
  measures.range = {-1.0F, 1.0F};
  const auto of = [&](MultiviewPreset preset)
  {
    MultiviewOptions options;
    options.preset = preset;
    return solverSettings(options, measures, row(9), 1.0);
  };
  const SolverSettings quality = of(MultiviewPreset::Quality);
  EXPECT_FALSE(quality.grey_search);
  EXPECT_FLOAT_EQ(quality.label_step_px, 1.0F / 16.0F);
  EXPECT_EQ(quality.search.visibility_passes, 2);
  EXPECT_EQ(quality.refinement.refinements, 3);
  EXPECT_TRUE(quality.search.fuse_background);
  const SolverSettings realtime = of(MultiviewPreset::Realtime);
  EXPECT_TRUE(realtime.grey_search);
  EXPECT_FLOAT_EQ(realtime.label_step_px, 1.0F / 8.0F);
  EXPECT_EQ(realtime.search.visibility_passes, 1);
  EXPECT_EQ(realtime.refinement.refinements, 1);
  EXPECT_FALSE(realtime.search.fuse_background);
}

TEST(SolverSettings, OptionsAreHandedOn)
{
  MultiviewOptions options;
  options.small_change_penalty = 17;
  options.large_change_penalty = 900;
  options.thin_structures = true;
  options.boundary_pixels = false;
  options.brightness_slope = false;
  options.refinement_smoothness = 50.0F;
  options.temporal = true;
  const SolverSettings settings = solverSettings(options, {}, row(9), 1.0);
  EXPECT_EQ(settings.search.paths.small_change_penalty, 17);
  EXPECT_EQ(settings.search.paths.large_change_penalty, 900);
  EXPECT_TRUE(settings.search.keep_thin_structures);
  EXPECT_FALSE(settings.decide_boundary_pixels);
  EXPECT_FALSE(settings.refinement.linearization.brightness_slope);
  EXPECT_FLOAT_EQ(settings.refinement.smoothing.strength, 50.0F);
  EXPECT_TRUE(settings.search.detect_changes);
}

TEST(SolverSettings, NoiseAndPairsAreAdaptedTo)
{
  SceneMeasures noisy;
  noisy.noise_sigma = 5.0F;
  EXPECT_GT(solverSettings({}, noisy, row(9), 1.0).blur_sigma_px, 0.8);
  const SolverSettings pair = solverSettings({}, {}, row(2), 0.25);
  EXPECT_EQ(pair.search.paths.large_change_penalty, 4 * 1200);
  EXPECT_EQ(pair.search.cost.unseen_penalty, pair.search.cost.truncation / 2);
}

TEST(SolverSettings, RealtimeSearchesAPairOnceWithFewerLabelsUnlessToldOtherwise)
{
  MultiviewOptions options;
  options.preset = MultiviewPreset::Realtime;
  EXPECT_EQ(solverSettings(options, {}, row(2), 0.25).search.visibility_passes, 0);
  EXPECT_FLOAT_EQ(solverSettings(options, {}, row(2), 0.25).label_step_px, 0.1875F);
  EXPECT_EQ(solverSettings(options, {}, row(3), 0.25).search.visibility_passes, 1);
  EXPECT_FLOAT_EQ(solverSettings(options, {}, row(3), 0.25).label_step_px, 0.125F);
  options.visibility_passes = 1;
  options.label_step_px = 0.125F;
  EXPECT_EQ(solverSettings(options, {}, row(2), 0.25).search.visibility_passes, 1);
  EXPECT_FLOAT_EQ(solverSettings(options, {}, row(2), 0.25).label_step_px, 0.125F);
}

}  // namespace
}  // namespace light_field_depth::multiview
