#include "core/preprocess/layout_views.h"

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
LightField grid(int rows, int columns)
{
  std::vector<View> views;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      views.push_back(gridView(row, column, cv::Mat(16, 16, CV_8UC1, cv::Scalar(0))));
    }
  }
  return makeLightField(views);
}

TEST(LayoutViews, DistancesAreOneTheHalfAndTheWholeReach)
{
  EXPECT_EQ(layoutDistances(grid(9, 9)), (std::vector<int>{1, 2, 4}));
  EXPECT_EQ(layoutDistances(grid(3, 9)), (std::vector<int>{1})) << "the shorter line decides";
  EXPECT_EQ(layoutDistances(grid(1, 7)), (std::vector<int>{1, 2, 3}))
      << "where there is one line only, its own";
  LightField diagonal = grid(3, 3);
  diagonal.views = {diagonal.views[0], diagonal.views[4], diagonal.views[8]};
  diagonal.reference_index = 1;
  EXPECT_TRUE(layoutDistances(diagonal).empty());
}

TEST(LayoutViews, OneViewOnEachSideOfTheReference)
{
  const LightField field = grid(5, 5);
  const LineViews row = viewsOnLine(field, true, 2);
  EXPECT_EQ(row.indices, (std::vector<std::size_t>{14, 10}));
  EXPECT_EQ(row.units, (std::vector<float>{1.0F, -1.0F}));
  const LineViews column = viewsOnLine(field, false, 1);
  EXPECT_EQ(column.indices, (std::vector<std::size_t>{17, 7}));
}

TEST(LayoutViews, TheNearestDistanceStandsInWithItsOwnUnit)
{
  LightField field = grid(1, 5);
  field.views.erase(field.views.begin() + 4);  // columns 0 to 3, reference 2
  const LineViews pair = viewsOnLine(field, true, 2);
  EXPECT_EQ(pair.indices, (std::vector<std::size_t>{3, 0}));
  EXPECT_EQ(pair.units, (std::vector<float>{0.5F, -1.0F}));
  EXPECT_TRUE(viewsOnLine(field, false, 1).indices.empty());
}

}  // namespace
}  // namespace light_field_depth
