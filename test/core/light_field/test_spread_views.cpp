#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "core/light_field/spread_views.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
LightField fieldOf(const std::vector<GridPosition>& positions)
{
  std::vector<View> views;
  views.reserve(positions.size());
  for (const GridPosition& position : positions)
  {
    views.push_back(gridView(position.row, position.column, cv::Mat::zeros(16, 16, CV_8UC1)));
  }
  return makeLightField(std::move(views));
}

std::set<std::pair<int, int>> places(const LightField& field, std::size_t count)
{
  std::set<std::pair<int, int>> found;
  for (const std::size_t index : spreadViews(field, count))
  {
    found.insert({field.views[index].grid.row, field.views[index].grid.column});
  }
  return found;
}

TEST(SpreadViews, AreTheEndsOfACrossAndTheCornersOfAGrid)
{
  const LightField cross = fieldOf(testing::crossPositions(9, 9));
  EXPECT_EQ(places(cross, 1), (std::set<std::pair<int, int>>{{4, 4}}));
  EXPECT_EQ(places(cross, 3), (std::set<std::pair<int, int>>{{4, 4}, {0, 4}, {8, 4}}))
      << "two that are opposite";
  EXPECT_EQ(places(cross, 5), (std::set<std::pair<int, int>>{{4, 4}, {0, 4}, {8, 4}, {4, 0}, {4, 8}}));
  const LightField grid = fieldOf(testing::gridPositions(3, 3));
  EXPECT_EQ(places(grid, 5), (std::set<std::pair<int, int>>{{1, 1}, {0, 0}, {0, 2}, {2, 0}, {2, 2}}));
  EXPECT_EQ(spreadViews(grid, 100).size(), 9U) << "no more than there are";
  EXPECT_EQ(spreadViews(grid, 5).front(), grid.reference_index);
}

TEST(TurnedTo, KeepsWhatTheViewsSeeOfAPoint)
{
  LightField field = fieldOf(testing::gridPositions(3, 3));
  field.views[7].offset_px = {0.5, -0.25};
  const LightField turned = turnedTo(field, 7);
  EXPECT_EQ(turned.reference_index, 7U);
  // A point of disparity d at p in view 7 stands at p - d steps + offset in another one.
  const double d = 1.5;
  const cv::Point2d in_reference(10.0, 20.0);
  const cv::Point2d in_seven = in_reference - d * field.views[7].steps + field.views[7].offset_px;
  for (std::size_t i = 0; i < field.views.size(); ++i)
  {
    const cv::Point2d expected = in_reference - d * field.views[i].steps + field.views[i].offset_px;
    const cv::Point2d found = in_seven - d * turned.views[i].steps + turned.views[i].offset_px;
    EXPECT_NEAR(found.x, expected.x, 1e-12);
    EXPECT_NEAR(found.y, expected.y, 1e-12);
  }
}

}  // namespace
}  // namespace light_field_depth
