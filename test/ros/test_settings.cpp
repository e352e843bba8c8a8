#include "ros/settings.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <boost/any.hpp>

#include "expect_sentence.h"
#include "light_field_depth/io/pipeline_options_io.h"

namespace light_field_depth
{
namespace
{
using testing::expectSentence;

LightFieldDepthConfig defaults()
{
  return LightFieldDepthConfig::__getDefault__();
}

/// A value of the .cfg as text, to be compared with that of the options; empty when there is none.
std::string textOf(const LightFieldDepthConfig& config, const std::string& name)
{
  for (const auto& description : LightFieldDepthConfig::__getParamDescriptions__())
  {
    if (description->name != name)
    {
      continue;
    }
    boost::any value;
    description->getValue(config, value);
    PipelineOptions options;
    if (const auto* const number = boost::any_cast<double>(&value))
    {
      setOption(options, name, std::to_string(*number));
    }
    else if (const auto* const whole = boost::any_cast<int>(&value))
    {
      setOption(options, name, std::to_string(*whole));
    }
    else if (const auto* const flag = boost::any_cast<bool>(&value))
    {
      setOption(options, name, *flag ? "true" : "false");
    }
    else
    {
      setOption(options, name, boost::any_cast<std::string>(value));
    }
    for (const NamedOption& option : listOptions(options))
    {
      if (option.name == name)
      {
        return toString(option.value);
      }
    }
  }
  return "";
}

TEST(Settings, OfTheParameterServerHaveTheDefaultsOfTheOptions)
{
  PipelineOptions of_node;
  of_node.multiview.registration = false;  // what it finds would be found again on every frame
  for (const NamedOption& option : listOptions(of_node))
  {
    EXPECT_EQ(textOf(defaults(), option.name), toString(option.value))
        << "add '" << option.name << "' to config/LightFieldDepth.cfg, or correct its default there";
  }
  EXPECT_EQ(defaults().disparity_range_auto, !PipelineOptions().disparity_range.has_value());
  EXPECT_EQ(defaults().dense_cloud, NodeSettings().dense_cloud);
  EXPECT_EQ(defaults().dense_cloud_max_rate_hz, NodeSettings().dense_cloud_max_rate_hz);
}

TEST(Settings, ReachTheOptionsByTheirNames)
{
  LightFieldDepthConfig config = defaults();
  config.method = "multiview";
  config.views = "star";
  config.min_confidence = 0.25;
  config.dense_cloud_voxel_size_m = 0.5;
  config.dense_cloud = false;
  config.dense_cloud_max_rate_hz = 2.0;
  const NodeSettings settings = settingsFrom(config);
  EXPECT_EQ(settings.pipeline.method, Method::Multiview);
  EXPECT_EQ(settings.pipeline.views, ViewSelection::Star);
  EXPECT_FLOAT_EQ(settings.pipeline.min_confidence, 0.25F);
  EXPECT_FLOAT_EQ(settings.pipeline.dense_cloud.voxel_size_m, 0.5F);
  EXPECT_FALSE(settings.dense_cloud);
  EXPECT_EQ(settings.dense_cloud_max_rate_hz, 2.0);
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

TEST(Settings, APresetSaysWhatItChanges)
{
  PipelineOptions before;
  PipelineOptions after;
  EXPECT_EQ(describePresetChange(before, after), "");
  after.multiview.preset = MultiviewPreset::Fast;
  const std::string sentence = describePresetChange(before, after);
  EXPECT_NE(sentence.find("The preset is now fast"), std::string::npos) << sentence;
  const int before_count = withPresetNumbers(before.multiview).refinements;
  const int count = withPresetNumbers(after.multiview).refinements;
  EXPECT_NE(sentence.find("multiview_refinements " + std::to_string(count) + " (was " +
                          std::to_string(before_count)),
            std::string::npos)
      << sentence;
}

}  // namespace
}  // namespace light_field_depth
