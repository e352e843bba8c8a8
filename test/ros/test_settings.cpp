#include "light_field_depth/ros/settings.h"

#include <limits>

#include <gtest/gtest.h>

#include "expect_sentence.h"

namespace light_field_depth
{
namespace
{
using testing::expectSentence;

LightFieldDepthConfig defaults()
{
  return LightFieldDepthConfig::__getDefault__();
}

TEST(Settings, TakeADisparityRangeOnlyWhenItIsNotToBeFound)
{
  LightFieldDepthConfig config = defaults();
  config.disparity_min = -1.5;
  config.disparity_max = 2.5;
  EXPECT_FALSE(settingsFrom(config).pipeline.disparity_range);
  config.disparity_range_auto = false;
  const auto range = settingsFrom(config).pipeline.disparity_range;
  ASSERT_TRUE(range);
  EXPECT_FLOAT_EQ(range->min, -1.5F);
  EXPECT_FLOAT_EQ(range->max, 2.5F);
}

TEST(Settings, RefuseWhatThePipelineRefuses)
{
  LightFieldDepthConfig config = defaults();
  config.disparity_range_auto = false;
  config.disparity_min = 3.0;
  config.disparity_max = -3.0;
  expectSentence([&] { settingsFrom(config); }, {"disparity_range", "3.0", "-3.0"});
  config = defaults();
  config.method = "magic";
  expectSentence([&] { settingsFrom(config); }, {"magic", "paper2017"});
  config = defaults();
  config.min_confidence = std::numeric_limits<double>::quiet_NaN();
  expectSentence([&] { settingsFrom(config); }, {"min_confidence"});
}

}  // namespace
}  // namespace light_field_depth
