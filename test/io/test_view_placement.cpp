#include "io/view_placement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "light_field_depth/core/error.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
/// Views of a grid that is numbered from 0, without positions.
FolderDescription numbered(int rows, int columns)
{
  FolderDescription description;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      ViewFile view;
      view.path = std::to_string(row) + "_" + std::to_string(column) + ".png";
      view.number = {row, column};
      description.views.push_back(view);
    }
  }
  return description;
}

/// The same with cameras 8 mm apart whose x runs against the columns.
FolderDescription positioned()
{
  FolderDescription description = numbered(3, 3);
  for (ViewFile& view : description.views)
  {
    view.position = cv::Point2d(100.0 - 8.0 * view.number.column, 8.0 * view.number.row);
  }
  description.position_unit_m = 1e-3;
  return description;
}

const View& viewAt(const PlacedViews& placed, int row, int column)
{
  return *std::find_if(placed.views.begin(), placed.views.end(),
                       [&](const View& view) {
                         return view.grid == GridPosition{row, column};
                       });
}

TEST(ViewPlacement, NumbersAreRowsAndColumnsWithTheMiddleAsReference)
{
  FolderDescription description = numbered(3, 5);
  const PlacedViews placed = placeViews("somewhere", description, {}, std::nullopt);
  ASSERT_EQ(placed.views.size(), 15U);
  EXPECT_EQ(placed.reference, (GridPosition{1, 2}));
  EXPECT_EQ(viewAt(placed, 2, 4).steps - viewAt(placed, 1, 2).steps, cv::Point2d(2, 1));
  EXPECT_TRUE(placed.own_reference);
  EXPECT_TRUE(placed.own_layout);
  EXPECT_EQ(placed.flip, Flip::None);
  EXPECT_EQ(placed.step_m, 0.0);
  EXPECT_EQ(description.views[7].path, "1_2.png") << "the files have the order of the views";
}

TEST(ViewPlacement, AFlipTurnsStepsAndPlaces)
{
  FolderDescription description = numbered(3, 3);
  Layout layout;
  layout.flip = Flip::Columns;
  const PlacedViews placed = placeViews("somewhere", description, layout, GridPosition{0, 0});
  EXPECT_EQ(placed.reference, (GridPosition{0, 2}));
  EXPECT_FALSE(placed.own_reference);
  EXPECT_FALSE(placed.own_layout);
  EXPECT_EQ(viewAt(placed, 0, 1).steps - viewAt(placed, 0, 2).steps, cv::Point2d(-1, 0));
  EXPECT_EQ(placed.reference_steps, cv::Point2d(1, -1)) << "from the middle to the upper right";
}

TEST(ViewPlacement, ColumnsFirstSwapsRowsForColumns)
{
  FolderDescription description = numbered(2, 4);
  Layout layout;
  layout.order = Order::ColumnMajor;
  const PlacedViews placed = placeViews("somewhere", description, layout, std::nullopt);
  EXPECT_EQ(placed.views.back().grid, (GridPosition{3, 1}));
  EXPECT_EQ(description.views.back().path, "1_3.png");
}

TEST(ViewPlacement, PositionsDecideSideAndStep)
{
  FolderDescription description = positioned();
  const PlacedViews placed = placeViews("somewhere", description, {}, std::nullopt);
  EXPECT_EQ(placed.flip, Flip::Columns) << "x falls from column to column";
  EXPECT_NEAR(placed.step_m, 0.008, 1e-12);
  const cv::Point2d steps = viewAt(placed, 1, 2).steps - viewAt(placed, 1, 1).steps;
  EXPECT_NEAR(steps.x, 1.0, 1e-9);
  EXPECT_NEAR(steps.y, 0.0, 1e-9);
}

TEST(ViewPlacement, WhatDoesNotFitIsSaid)
{
  FolderDescription twice = numbered(2, 2);
  twice.views[3].number = {0, 0};
  EXPECT_NE(
      testing::messageOf<InputError>([&] { placeViews("there", twice, {}, std::nullopt); }).find("0_0.png"),
      std::string::npos);
  FolderDescription description = numbered(2, 2);
  EXPECT_FALSE(testing::messageOf<InputError>(
                   [&] {
                     placeViews("there", description, {}, GridPosition{7, 7});
                   })
                   .empty());
  FolderDescription apart = positioned();
  apart.step_length = 80.0;
  EXPECT_NE(testing::messageOf<InputError>([&] { placeViews("there", apart, {}, std::nullopt); })
                .find("make them agree"),
            std::string::npos);
}

}  // namespace
}  // namespace light_field_depth
