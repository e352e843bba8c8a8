#include <gtest/gtest.h>

#include <set>
#include <string>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/pipeline_options_io.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
std::string settingError(const std::string& name, const std::string& text)
{
  return testing::messageOf<InputError>(
      [&]
      {
        PipelineOptions options;
        setOption(options, name, text);
      });
}

std::string valueOf(const PipelineOptions& options, const std::string& name)
{
  for (const NamedOption& option : listOptions(options))
  {
    if (option.name == name)
    {
      return toString(option.value);
    }
  }
  return "absent";
}

TEST(PipelineOptionsIo, EveryNameIsUniqueAndEveryDefaultCanBeSetAgain)
{
  std::set<std::string> names;
  PipelineOptions options;
  for (const NamedOption& option : listOptions(options))
  {
    EXPECT_TRUE(names.insert(option.name).second) << option.name;
    EXPECT_EQ(option.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos)
        << option.name << " must do as a ROS parameter";
    EXPECT_NO_THROW(setOption(options, option.name, toString(option.value))) << option.name;
    EXPECT_EQ(valueOf(options, option.name), toString(option.value)) << option.name;
  }
  EXPECT_GT(names.size(), 20U);
}

TEST(PipelineOptionsIo, TakesAnAssignment)
{
  PipelineOptions options;
  setOption(options, "cpm_levels=3");
  EXPECT_EQ(options.paper2017.patch_match.levels, 3);
  EXPECT_EQ(testing::messageOf<InputError>([&] { setOption(options, "cpm_levels"); }),
            "A setting is given as NAME=VALUE, but this one is 'cpm_levels'.");
}

TEST(PipelineOptionsIo, SetsEveryKindOfValue)
{
  PipelineOptions options;
  setOption(options, "feature_flow", "false");
  EXPECT_FALSE(options.paper2017.feature_flow.enabled);
  setOption(options, "cpm_levels", "3");
  EXPECT_EQ(options.paper2017.patch_match.levels, 3);
  setOption(options, "filter_sigma_range", "0.25");
  EXPECT_EQ(options.paper2017.feature_flow.sigma_range, 0.25);
  setOption(options, "min_confidence", "0.1");
  EXPECT_EQ(options.min_confidence, 0.1F);
  EXPECT_EQ(valueOf(options, "min_confidence"), "0.1") << "single precision does not show";
  setOption(options, "views", "star");
  EXPECT_EQ(options.views, ViewSelection::Star);
  setOption(options, "initializer", "dis");
  EXPECT_EQ(options.paper2017.initializer, FlowInitializer::Dis);
  setOption(options, "volume_rows", "3,4, 5");
  EXPECT_EQ(options.paper2017.volumes.rows, "3,4, 5");
  EXPECT_EQ(valueOf(options, "volume_rows"), "3,4, 5");
  setOption(options, "volume_rows", "");
  EXPECT_TRUE(options.paper2017.volumes.rows.empty());
}

TEST(PipelineOptionsIo, NamesTheSettingThatCannotBeSet)
{
  EXPECT_NE(settingError("cpm_leveels", "3").find("cpm_levels"), std::string::npos) << "the names are listed";
  for (const auto& [name, text] :
       {std::make_pair("cpm_levels", "3.5"), std::make_pair("cpm_levels", ""),
        std::make_pair("cpm_levels", "3 4"), std::make_pair("cpm_levels", "99999999999999"),
        std::make_pair("feature_flow", "maybe"), std::make_pair("filter_sigma_range", "wide"),
        std::make_pair("min_confidence", "1e999")})
  {
    const std::string message = settingError(name, text);
    EXPECT_NE(message.find(name), std::string::npos) << name << " " << text << ": " << message;
  }
  EXPECT_NE(settingError("views", "some"), "");
}

TEST(PipelineOptionsIo, ReadsAFileOfSettings)
{
  const testing::TemporaryFolder folder;
  PipelineOptions options;
  readOptionsFile(folder.write("options.yaml",
                               "# for a close scene\nviews: all\ncpm_subpixel: no\n"
                               "volume_columns: [2, 3]\ndisparity_range: [-2.5, 4]\n"),
                  options);
  EXPECT_EQ(options.views, ViewSelection::All);
  EXPECT_FALSE(options.paper2017.patch_match.subpixel);
  EXPECT_EQ(options.paper2017.volumes.columns, "2,3");
  ASSERT_TRUE(options.disparity_range);
  EXPECT_EQ(options.disparity_range->min, -2.5F);
  EXPECT_EQ(options.disparity_range->max, 4.0F);
}

TEST(PipelineOptionsIo, NamesTheFileThatIsWrong)
{
  const testing::TemporaryFolder folder;
  for (const char* const content :
       {"", "5", "- a", "nonsense: 3\n", "cpm_levels: many\n", "cpm_levels: {a: 1}\n", "cpm_levels: [[1]]\n",
        "disparity_range: 5\n", "a: [\n", "? [a]\n: 3\n", "cpm_levels:\n"})
  {
    const auto path = folder.write("options.yaml", content);
    const std::string message = testing::messageOf<InputError>(
        [&]
        {
          PipelineOptions options;
          readOptionsFile(path, options);
        });
    EXPECT_NE(message.find("options.yaml"), std::string::npos) << content << ": " << message;
  }
}

}  // namespace
}  // namespace light_field_depth
