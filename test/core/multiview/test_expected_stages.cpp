#include "core/multiview/expected_stages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace light_field_depth::multiview
{
namespace
{
using Stages = std::vector<ExpectedStage>;

double total(const Stages& stages)
{
  double sum = 0.0;
  for (const ExpectedStage& stage : stages)
  {
    sum += stage.share;
  }
  return sum;
}

int countOf(const Stages& stages, const std::string& name)
{
  return static_cast<int>(std::count_if(stages.begin(), stages.end(),
                                        [&](const ExpectedStage& stage) { return stage.stage == name; }));
}

TEST(ExpectedStages, RepeatWhatTheOptionsRepeat)
{
  MultiviewOptions options;
  options.visibility_passes = 3;
  options.refinements = 2;
  const Stages stages = expectedStages(options, false, false);
  EXPECT_EQ(stages.front().stage, "exposure");
  EXPECT_EQ(stages.back().stage, "confidence");
  EXPECT_EQ(countOf(stages, "visible_cost"), 3);
  EXPECT_EQ(countOf(stages, "linearize"), 2);
  EXPECT_EQ(countOf(stages, "aggregate"), 2 + 3);
  options.visibility_passes = 0;
  EXPECT_EQ(countOf(expectedStages(options, false, false), "visibility"), 0);
}

TEST(ExpectedStages, TheNumbersOfThePresetCount)
{
  MultiviewOptions options;
  options.preset = MultiviewPreset::Quality;
  EXPECT_EQ(countOf(expectedStages(options, false, false), "visibility"), 2);
  EXPECT_EQ(countOf(expectedStages(options, false, false), "linearize"), 3);
}

TEST(ExpectedStages, HalfTheResolutionIsAQuarterOfTheWork)
{
  const Stages once = expectedStages({}, false, false);
  const Stages twice = expectedStages({}, true, false);
  const double measuring = 11.7;
  EXPECT_NEAR(total(twice) - total(once), 0.25 * (total(once) - measuring) + 1.0, 1e-9);
  EXPECT_EQ(countOf(twice, "upsample"), 1);
  EXPECT_EQ(countOf(twice, "cost"), 2);
}

TEST(ExpectedStages, ThePairsOtherMapIsASearchAtHalfTheResolution)
{
  const Stages once = expectedStages({}, false, false);
  const Stages pair = expectedStages({}, false, true);
  const double searching = 23.9;
  EXPECT_NEAR(total(pair) - total(once), 0.25 * searching + 1.0, 1e-9);
  EXPECT_EQ(countOf(pair, "cost"), 2);
  EXPECT_EQ(countOf(pair, "linearize"), countOf(once, "linearize"));
  EXPECT_EQ(pair.back().stage, "left_right_check");
}

}  // namespace
}  // namespace light_field_depth::multiview
