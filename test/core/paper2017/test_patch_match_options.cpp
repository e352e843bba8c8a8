#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "light_field_depth/core/paper2017_options.h"

namespace light_field_depth
{
namespace
{
TEST(PatchMatchOptions, TheDefaultsCanBeUsed)
{
  EXPECT_TRUE(validate(PatchMatchOptions{}).empty());
}

TEST(PatchMatchOptions, EachFieldThatCannotBeUsedHasASentenceWithItsNameAndLimits)
{
  PatchMatchOptions options;
  options.levels = 0;
  options.pyramid_ratio = 0.95;
  options.grid_spacing_px = 17;
  options.iterations = 0;
  options.search_radius_px = 65;
  options.max_displacement_px = 0.5;
  options.consistency_threshold_px = 0.0;
  options.confidence_sigma_px = 0.0;
  options.min_region_seeds = -1;
  options.border_px = 65;
  const std::vector<std::string> sentences = validate(options);
  const std::vector<std::string> expected = {
      "cpm_levels is 0; it must be between 1 and 12.",
      "cpm_pyramid_ratio is 0.95",
      "cpm_grid_spacing_px is 17; it must be between 1 and 16 pixels.",
      "cpm_iterations is 0; it must be between 1 and 100.",
      "cpm_search_radius_px is 65; it must be between 1 and 64 pixels.",
      "cpm_max_displacement_px is 0.5",
      "cpm_consistency_threshold_px is 0.0",
      "cpm_confidence_sigma_px is 0.0",
      "cpm_min_region_seeds is -1; it must be between 0 and 100000 seeds.",
      "cpm_border_px is 65; it must be between 0 and 64 pixels."};
  ASSERT_EQ(sentences.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_EQ(sentences[i].rfind(expected[i], 0), 0U) << sentences[i];
  }
}

TEST(PatchMatchOptions, WhatIsNotANumberCannotBeUsed)
{
  PatchMatchOptions options;
  options.confidence_sigma_px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(validate(options).size(), 1U);
}

}  // namespace
}  // namespace light_field_depth
