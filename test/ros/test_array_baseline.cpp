#include "ros/array_baseline.h"

#include <gtest/gtest.h>

#include <string>

#include "light_field_depth/core/error.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
TEST(ArrayBaseline, IsTheMedianBetweenNeighboursInARow)
{
  const std::vector<GridPosition> grid = {{0, 0}, {0, 1}, {0, 2}, {0, 5}};
  const std::vector<cv::Point2d> positions = {{0.0, 0.0}, {0.1, 0.0}, {0.21, 0.0}, {0.81, 0.0}};
  EXPECT_NEAR(adjacentBaseline(grid, positions), 0.11, 1e-12) << "0.1, 0.11 and three steps of 0.2";
  EXPECT_FALSE(rowBaseline(grid, positions));
}

TEST(ArrayBaseline, RowsCountOnTheirOwnAndWhereThereIsNothingElse)
{
  const std::vector<GridPosition> grid = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
  const std::vector<cv::Point2d> positions = {{0.0, 0.0}, {0.1, 0.0}, {0.0, 0.3}, {0.1, 0.3}};
  EXPECT_NEAR(adjacentBaseline(grid, positions), 0.1, 1e-12);
  ASSERT_TRUE(rowBaseline(grid, positions));
  EXPECT_NEAR(*rowBaseline(grid, positions), 0.3, 1e-12);
  EXPECT_NEAR(adjacentBaseline({{0, 0}, {2, 0}}, {{0.0, 0.0}, {0.0, 0.5}}), 0.25, 1e-12);
}

TEST(ArrayBaseline, ViewsInTheWrongOrderAreNamed)
{
  const std::string in_row = testing::messageOf<InputError>(
      [] {
        adjacentBaseline({{0, 0}, {0, 1}}, {{0.1, 0.0}, {0.0, 0.0}});
      });
  EXPECT_NE(in_row.find("View (0, 1): -P[3] / P[0] of its CameraInfo places it at 0 m"), std::string::npos)
      << in_row;
  EXPECT_NE(in_row.find("from left to right"), std::string::npos) << in_row;
  const std::string in_column = testing::messageOf<InputError>(
      [] {
        adjacentBaseline({{0, 0}, {1, 0}}, {{0.0, 0.1}, {0.0, 0.0}});
      });
  EXPECT_NE(in_column.find("from top to bottom"), std::string::npos) << in_column;
  const std::string apart = testing::messageOf<InputError>(
      [] {
        adjacentBaseline({{0, 0}, {1, 1}}, {{0.0, 0.0}, {0.1, 0.1}});
      });
  EXPECT_NE(apart.find("No two of the 2 views share a row or a column"), std::string::npos) << apart;
}

}  // namespace
}  // namespace light_field_depth
