#include "io/yaml_fields.h"

#include <gtest/gtest.h>

#include <string>

#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
YamlFields fieldsOf(const std::string& text, const std::string& name = "")
{
  return {"file.yaml", name, YAML::Load(text)};
}

template <class Action>
std::string complaint(const Action& action)
{
  return testing::messageOf<InputError>([&] { action(); });
}

TEST(YamlFields, GivesWhatIsThere)
{
  const YamlFields fields = fieldsOf("{focal_length_px: 80.5, grid: [9, 7], point: [1.5, -2], name: a}");
  EXPECT_EQ(fields.positive("focal_length_px"), 80.5);
  EXPECT_EQ(fields.integerPair("grid", "two numbers"), (std::pair<int, int>(9, 7)));
  EXPECT_EQ(fields.numberPair("point", "two numbers"), (std::pair<double, double>(1.5, -2.0)));
  EXPECT_EQ(fields.get<std::string>("name", "a text"), "a");
  EXPECT_FALSE(fields.has("baseline_m"));
  EXPECT_FALSE(fields.positive("baseline_m"));
}

TEST(YamlFields, ComplaintsNameFileFieldAndWhatIsWanted)
{
  const YamlFields fields =
      fieldsOf("{focal_length_px: wide, baseline_m: -1, grid: [9], colour: red}", "camera");
  EXPECT_EQ(complaint([&] { fields.get<double>("focal_length_px", "a number"); }),
            "In 'file.yaml', camera.focal_length_px is 'wide'; it must be a number.");
  EXPECT_NE(complaint([&] { fields.positive("baseline_m"); }).find("camera.baseline_m is '-1'"),
            std::string::npos);
  EXPECT_NE(complaint([&] { fields.integerPair("grid", "[rows, columns]"); }).find("[rows, columns]"),
            std::string::npos);
  EXPECT_NE(complaint(
                [&] {
                  fields.allowOnly({"focal_length_px", "baseline_m", "grid"});
                })
                .find("colour"),
            std::string::npos);
  EXPECT_NE(complaint([&] { fieldsOf("[1, 2]"); }).find("not a map"), std::string::npos);
}

TEST(YamlFields, ABrokenFileIsNamedWithItsLine)
{
  const testing::TemporaryFolder folder;
  folder.write("broken.yaml", "grid: 3\nviews: [1, 2\n");
  const std::string sentence = complaint([&] { loadYaml(folder / "broken.yaml"); });
  EXPECT_NE(sentence.find("broken.yaml"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("line"), std::string::npos) << sentence;
}

}  // namespace
}  // namespace light_field_depth
