#include <string>

#include <gtest/gtest.h>

#include "light_field_depth/core/multiview_options.h"

namespace light_field_depth
{
namespace
{
TEST(MultiviewOptions, ThePresetDecidesWhatIsLeftToIt)
{
  MultiviewOptions options;
  options.preset = MultiviewPreset::Quality;
  options.refinements = 0;
  const MultiviewOptions chosen = withPresetNumbers(options);
  EXPECT_EQ(chosen.label_step_px, 0.0625F);
  EXPECT_EQ(chosen.visibility_passes, 2);
  EXPECT_EQ(chosen.refinements, 0);
  options.preset = MultiviewPreset::Fast;
  EXPECT_EQ(withPresetNumbers(options).visibility_passes, 1);
}

TEST(MultiviewOptions, AreEqualIfEachFieldIs)
{
  EXPECT_TRUE(MultiviewOptions() == MultiviewOptions());
  MultiviewOptions other;
  other.temporal = true;
  EXPECT_FALSE(MultiviewOptions() == other);
  other = {};
  other.refinement_smoothness = 201.0F;
  EXPECT_FALSE(MultiviewOptions() == other);
}

TEST(MultiviewOptions, EachValueThatCannotBeUsedHasASentence)
{
  EXPECT_TRUE(validate(MultiviewOptions()).empty());
  MultiviewOptions options;
  options.label_step_px = 2.0F;
  options.small_change_penalty = 0;
  options.refinement_smoothness = -1.0F;
  const auto problems = validate(options);
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(problems[0],
            "multiview.label_step_px is 2.000000; it must be between 1/32 and 1 px, or -1 for the preset's "
            "number.");
}

}  // namespace
}  // namespace light_field_depth
