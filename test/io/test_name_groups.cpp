#include "io/name_groups.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/scene_folders.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/dataset.h"

namespace light_field_depth
{
namespace
{
NameGroup groupOf(const std::vector<std::string>& names)
{
  NameGroup group;
  for (const std::string& name : names)
  {
    group.names.push_back(takeApart(name));
    group.form = group.names.back().form;
  }
  return group;
}

std::vector<std::filesystem::path> paths(const std::vector<std::string>& names)
{
  return {names.begin(), names.end()};
}

TEST(NameGroups, NamesAreTakenApartIntoNumbersAndText)
{
  const NumberedName name = takeApart("folder/VIEW_007_-02-3.PNG");
  EXPECT_EQ(name.form, "view_#_#-#") << "a minus after a digit is none";
  EXPECT_EQ(name.numbers, (std::vector<long long>{7, -2, 3}));
  EXPECT_EQ(name.digits, (std::vector<std::size_t>{3, 2, 1}));
  EXPECT_TRUE(takeApart("holiday.png").numbers.empty());
}

TEST(NameGroups, RowAndColumnAreTheTwoNumbersThatFillAGrid)
{
  std::vector<std::string> names;
  for (int i = 0; i < 6; ++i)
  {
    names.push_back("lf12_" + std::to_string(i) + "_" + std::to_string(i / 3) + "_" + std::to_string(i % 3) +
                    ".png");
  }
  const NameGroup group = groupOf(names);
  EXPECT_EQ(group.varying(), (std::vector<std::size_t>{1, 2, 3}));
  const auto places = rowAndColumnIn(group);
  ASSERT_TRUE(places);
  EXPECT_EQ(*places, (std::pair<std::size_t, std::size_t>(2, 3)));
}

TEST(NameGroups, ASingleRowHasItsNumberBesideOneThatIsAlwaysTheSame)
{
  const auto row = rowAndColumnIn(groupOf({"03_00.png", "03_01.png", "03_02.png"}));
  ASSERT_TRUE(row);
  EXPECT_EQ(*row, (std::pair<std::size_t, std::size_t>(0, 1)));
  EXPECT_FALSE(rowAndColumnIn(groupOf({"0001_00.png", "0001_01.png"}))) << "frame and view";
  EXPECT_FALSE(rowAndColumnIn(groupOf({"1.png", "2.png"})));
}

TEST(NameGroups, WordsSayWhatIsNoView)
{
  for (const char* const name : {"depth_#_#", "gt_disp_#", "lf_#_mask", "Thumbnail#"})
  {
    EXPECT_TRUE(saysNoView(name)) << name;
  }
  for (const char* const name : {"view_#_#", "masked_#", "indepth_#"})
  {
    EXPECT_FALSE(saysNoView(name)) << name;
  }
}

TEST(NameGroups, TheLargestGroupIsTheViewsAndTheRestIsLeftOut)
{
  const auto views =
      viewNames("somewhere", paths({"a_00_00.png", "a_00_01.png", "a_00_00_mask.png", "thumbnail.png"}));
  ASSERT_TRUE(views);
  EXPECT_EQ(views->group.form, "a_#_#");
  EXPECT_EQ(views->group.names.size(), 2U);
  EXPECT_EQ(views->left_out.size(), 2U);
  EXPECT_EQ(leftOutNotes(views->left_out),
            (std::vector<std::string>{"'thumbnail.png' and 1 more are left out: not named like the views."}));
  EXPECT_FALSE(viewNames("somewhere", paths({"dog.png", "holiday.png"})));
}

TEST(NameGroups, TwoDatasetsInOneFolderAreRefused)
{
  const std::string sentence = testing::messageOf<InputError>(
      [] {
        viewNames("there", paths({"a_00_00.png", "a_00_01.png", "b_00_00.png", "b_00_01.png"}));
      });
  EXPECT_NE(sentence.find("'there' mixes two datasets: 'a_00_00.png' is named a_#_#"), std::string::npos)
      << sentence;
}

}  // namespace
}  // namespace light_field_depth
