#include "ros/view_quorum.h"

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
ViewArray gridArray(int rows, int columns, std::size_t reference)
{
  ViewArray array;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      array.views.push_back({{row, column}, "image", "info"});
    }
  }
  array.reference = reference;
  return array;
}

std::vector<bool> without(std::size_t views, const std::vector<std::size_t>& missing)
{
  std::vector<bool> present(views, true);
  for (const std::size_t view : missing)
  {
    present[view] = false;
  }
  return present;
}

TEST(ViewQuorum, NeedsThreeQuartersUnlessTold)
{
  const ViewQuorum quorum(gridArray(3, 3, 4), 0);
  EXPECT_EQ(quorum.minViews(), 7U);
  EXPECT_TRUE(quorum.isEnough(without(9, {0, 8})));
  EXPECT_FALSE(quorum.isEnough(without(9, {0, 1, 8})));
  EXPECT_TRUE(ViewQuorum(gridArray(3, 3, 4), 5).isEnough(without(9, {0, 1, 8})));
}

TEST(ViewQuorum, NeedsTheReferenceAndBothDirections)
{
  const ViewQuorum quorum(gridArray(3, 3, 4), 5);
  EXPECT_FALSE(quorum.isEnough(without(9, {4}))) << "the reference";
  EXPECT_FALSE(quorum.isEnough(without(9, {0, 3, 6}))) << "nothing on the left";
  EXPECT_TRUE(quorum.isEnough(without(9, {0, 3})));
  const ViewQuorum at_the_end(gridArray(1, 5, 0), 3);
  EXPECT_TRUE(at_the_end.isEnough(without(5, {3, 4}))) << "the array has no left side";
}

TEST(ViewQuorum, NeverTakesAReferenceAlone)
{
  EXPECT_FALSE(ViewQuorum(gridArray(1, 2, 0), 1).isEnough(without(2, {1})));
}

}  // namespace
}  // namespace light_field_depth
