#include "core/multiview/noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include <opencv2/core.hpp>

namespace light_field_depth::multiview
{
namespace
{
SolverSettings adapted(float noise_sigma, SolverSettings settings = {})
{
  adaptToNoise(noise_sigma, settings);
  return settings;
}

TEST(AdaptToNoise, CleanViewsLeaveTheSettingsAlone)
{
  const SolverSettings before;
  const SolverSettings after = adapted(1.1F);
  EXPECT_FLOAT_EQ(after.noise_sigma, 1.1F);
  EXPECT_EQ(after.blur_sigma_px, 0.0);
  EXPECT_EQ(after.search.cost.truncation, before.search.cost.truncation);
  EXPECT_EQ(after.search.paths.small_change_penalty, before.search.paths.small_change_penalty);
  EXPECT_EQ(after.refinement.linearization.window_radius, before.refinement.linearization.window_radius);
  EXPECT_EQ(after.search.visibility_passes, before.search.visibility_passes);
}

TEST(AdaptToNoise, TheBlurGrowsAndWhatItLeavesRaisesTruncationAndPenalty)
{
  const SolverSettings before;
  const SolverSettings after = adapted(5.0F);
  EXPECT_NEAR(after.blur_sigma_px, 0.83, 1e-6);
  // A Gaussian of sigma s leaves 1 / (2 sqrt(pi) s) of white noise.
  const double left = 5.0 / (2.0 * std::sqrt(CV_PI) * 0.83);
  EXPECT_EQ(after.search.paths.small_change_penalty,
            before.search.paths.small_change_penalty + cvRound(10.0 * left));
  EXPECT_EQ(after.search.cost.truncation, 30) << "17 would be enough, and it never falls";
  EXPECT_EQ(adapted(40.0F).search.cost.truncation, 60) << "the most";
  EXPECT_EQ(adapted(40.0F).search.cost.unseen_penalty, 60) << "unseen is never better than badly seen";
  EXPECT_NEAR(adapted(40.0F).blur_sigma_px, 1.2, 1e-6);
}

TEST(AdaptToNoise, LabelsAreNoFinerThanNoiseLetsSee)
{
  SolverSettings fine;
  fine.label_step_px = 1.0F / 16.0F;
  EXPECT_FLOAT_EQ(adapted(1.0F, fine).label_step_px, 0.0625F);
  EXPECT_FLOAT_EQ(adapted(2.0F, fine).label_step_px, 0.125F);
}

TEST(AdaptToNoise, StrongNoiseWidensTheWindowAndRepeatsStages)
{
  EXPECT_EQ(adapted(2.4F).refinement.linearization.window_radius, 2);
  const SolverSettings strong = adapted(2.6F);
  EXPECT_EQ(strong.refinement.linearization.window_radius, 4);
  EXPECT_EQ(strong.search.visibility_passes, 3);
  EXPECT_EQ(strong.refinement.refinements, 3);
  EXPECT_FLOAT_EQ(strong.search.last_small_change_share, 1.0F);
  SolverSettings grey;
  grey.grey_search = true;
  EXPECT_EQ(adapted(2.6F, grey).refinement.linearization.window_radius, 4);
  EXPECT_EQ(adapted(2.6F, grey).search.visibility_passes, 1);
  EXPECT_EQ(adapted(2.6F, grey).refinement.refinements, 2);
  SolverSettings without;
  without.search.visibility_passes = 0;
  without.refinement.refinements = 0;
  EXPECT_EQ(adapted(2.6F, without).search.visibility_passes, 0) << "what was switched off stays off";
  EXPECT_EQ(adapted(2.6F, without).refinement.refinements, 0);
}

}  // namespace
}  // namespace light_field_depth::multiview
