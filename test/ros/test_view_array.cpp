#include "light_field_depth/ros/view_array.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "expect_sentence.h"
#include "light_field_depth/ros/yaml_parameter.h"

namespace light_field_depth
{
namespace
{
using testing::expectSentence;
using XmlRpc::XmlRpcValue;

ViewArray parse(const std::string& yaml)
{
  return viewArrayFromParameter(parameterFromYaml(yaml));
}

TEST(ViewArray, TakesAPatternAndALayout)
{
  const ViewArray array =
      parse("{rows: 5, columns: 5, layout: cross, image_topic: 'c{column}/r{row}/image'}");
  ASSERT_EQ(array.views.size(), 9U);
  EXPECT_TRUE((array.views[array.reference].grid == GridPosition{2, 2}));
  EXPECT_EQ(array.views[0].image, "c2/r0/image");
  EXPECT_EQ(array.views[0].camera_info, "view_0_2/camera_info");
}

TEST(ViewArray, LaysTheCrossThroughTheReference)
{
  const ViewArray array = parse("{rows: 3, columns: 3, layout: row, reference: [0, 1]}");
  ASSERT_EQ(array.views.size(), 3U);
  EXPECT_EQ(array.views[2].grid.row, 0);
  EXPECT_EQ(array.reference, 1U);
}

TEST(ViewArray, TakesAListInAnyOrder)
{
  const ViewArray array = parse(
      "{views: [{row: 0, column: 1, image: right, camera_info: right_info},"
      "{row: 0, column: 0, image: left, camera_info: left_info}], reference: [0, 1]}");
  ASSERT_EQ(array.views.size(), 2U);
  EXPECT_EQ(array.views[0].image, "left");
  EXPECT_EQ(array.reference, 1U);
  EXPECT_EQ(describe(array.views[0]), "View (0, 0) (left)");
}

TEST(ViewArray, NamesFieldAndRemedyOfWhatCannotBeUsed)
{
  const std::map<std::string, std::vector<std::string>> cases = {
      {"[1, 2]", {"'array'", "field: value"}},
      {"{columns: 3}", {"'array/rows'", "missing"}},
      {"{rows: three, columns: 3}", {"'array/rows'", "whole number"}},
      {"{rows: 0, columns: 3}", {"'array/rows'", "is 0", "from 1"}},
      {"{rows: 3, columns: 3, layout: circle}", {"'array/layout'", "circle", "cross"}},
      {"{rows: 3, columns: 3, layout: auto}", {"'array/layout'", "auto"}},
      {"{rows: 3, columns: 3, colums: 4}", {"'colums'", "not known", "columns"}},
      {"{rows: 3, columns: 3, reference: [9, 9]}", {"(9, 9)", "not among"}},
      {"{rows: 3, columns: 3, reference: [1]}", {"'array/reference'", "a row and a column"}},
      {"{rows: 3, columns: 3, image_topic: camera}", {"View (0, 1)", "camera", "{row}"}},
      {"{rows: 1, columns: 1}", {"1 view(s)", "two views"}},
      {"{rows: 3, columns: 1, layout: row}", {"row", "only the reference view"}},
      {"{views: [{row: 0, column: 0, image: a, camera_info: b}]}", {"two views"}},
      {"{views: [{row: 0, column: 0, image: a}, {row: 0, column: 1, image: c, camera_info: d}]}",
       {"'array/views[0]/camera_info'", "missing"}},
      {"{views: [{row: 0, column: 0, image: a, camera_info: b}, {row: 0, column: 0, image: c, camera_info: "
       "d}]}",
       {"(0, 0)", "occurs twice"}},
      {"{rows: 3, columns: 3, image_topic: 'view {row} {column}'}", {"View (0, 0)", "'view 0 0'", "topic"}},
      {"{rows: 3, columns: 3, camera_info_topic: '~{row}{column}'}", {"View (0, 0)", "'~00'", "topic"}},
      {"{views: left}", {"'array/views'", "list"}},
  };
  for (const auto& [yaml, parts] : cases)
  {
    SCOPED_TRACE(yaml);
    expectSentence([&yaml = yaml] { parse(yaml); }, parts);
  }
}

TEST(ViewArray, ReadsEveryFileThatIsShipped)
{
  const std::map<std::string, std::size_t> views = {{"cross_9x9", 17},  {"grid_9x9", 81}, {"grid_3x3", 9},
                                                    {"row_1x5", 5},     {"stereo", 2},    {"cross_17x17", 33},
                                                    {"grid_17x17", 289}};
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator("config/arrays"))
  {
    const std::string name = entry.path().stem().string();
    ASSERT_EQ(views.count(name), 1U) << name;
    std::ifstream file(entry.path());
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    const XmlRpcValue parameters = parameterFromYaml(text);
    EXPECT_EQ(viewArrayFromParameter(parameters["array"]).views.size(), views.at(name)) << name;
    ++files;
  }
  EXPECT_EQ(files, views.size());
}

TEST(ViewArray, IsTheCrossByDefault)
{
  const ViewArray array = defaultViewArray();
  EXPECT_EQ(array.views.size(), 17U);
  EXPECT_EQ(array.views[array.reference].image, "view_4_4/image_rect_color");
}

TEST(ViewArray, ViewsMayHaveMasks)
{
  const ViewArray pattern =
      parse("{rows: 1, columns: 2, mask_topic: 'm_{column}', mask_file: '/a/{row}_{column}.png'}");
  EXPECT_EQ(pattern.views[1].mask, "m_1");
  EXPECT_EQ(pattern.views[1].mask_file, "/a/0_1.png");
  const ViewArray list = parse(
      "{views: [{row: 0, column: 0, image: a, camera_info: ai, mask: am}, {row: 0, column: 1, image: b, "
      "camera_info: bi}]}");
  EXPECT_EQ(list.views[0].mask, "am");
  EXPECT_TRUE(list.views[1].mask.empty());
  expectSentence([] { parse("{rows: 1, columns: 2, mask_topic: '1_{column}'}"); }, {"(0, 0)", "1_0"});
}

}  // namespace
}  // namespace light_field_depth
