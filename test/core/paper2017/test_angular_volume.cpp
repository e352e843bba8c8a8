#include <utility>

#include <gtest/gtest.h>

#include "core/paper2017/angular_volume.h"
#include "light_field_depth/core/error.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
LightField field(const std::vector<GridPosition>& positions)
{
  std::vector<View> views;
  for (const GridPosition& position : positions)
  {
    views.push_back(gridView(position.row, position.column, cv::Mat::zeros(16, 16, CV_8UC1)));
  }
  return makeLightField(std::move(views));
}

std::vector<GridPosition> positionsOf(const LightField& light_field, const AngularVolume& volume)
{
  std::vector<GridPosition> positions;
  for (const std::size_t index : volume.view_indices)
  {
    positions.push_back(light_field.views[index].grid);
  }
  return positions;
}

TEST(AngularVolume, TakesTheRowAndTheColumnOfTheReferenceView)
{
  const LightField light_field = field(testing::gridPositions(3, 5));
  const auto volumes = extractVolumes(light_field, ViewSelection::Auto);
  ASSERT_EQ(volumes.size(), 2U);
  EXPECT_EQ(volumes[0].name, "row_1");
  EXPECT_EQ(positionsOf(light_field, volumes[0]),
            (std::vector<GridPosition>{{1, 0}, {1, 1}, {1, 2}, {1, 3}, {1, 4}}));
  EXPECT_EQ(volumes[1].name, "column_2");
  EXPECT_EQ(positionsOf(light_field, volumes[1]), (std::vector<GridPosition>{{0, 2}, {1, 2}, {2, 2}}));
}

TEST(AngularVolume, FollowsTheViewSelection)
{
  const LightField light_field = field(testing::gridPositions(3, 3));
  EXPECT_EQ(extractVolumes(light_field, ViewSelection::Row).size(), 1U);
  EXPECT_EQ(extractVolumes(light_field, ViewSelection::Column).front().name, "column_1");
  EXPECT_EQ(extractVolumes(light_field, ViewSelection::Star).size(), 4U);
  EXPECT_EQ(extractVolumes(light_field, ViewSelection::All).size(), 6U);
}

TEST(AngularVolume, UsesExactlyTheNamedRowsAndColumns)
{
  const LightField light_field = field(testing::gridPositions(4, 4));
  AngularVolumeOptions options;
  options.rows = "0, 3";
  options.columns = "2";
  const auto volumes = extractVolumes(light_field, ViewSelection::Auto, options);
  ASSERT_EQ(volumes.size(), 3U);
  EXPECT_EQ(volumes[1].name, "row_3");
  EXPECT_EQ(volumes[2].name, "column_2");
  options.rows = "7";
  EXPECT_THROW(extractVolumes(light_field, ViewSelection::Auto, options), InputError);
  options.rows = "one";
  EXPECT_EQ(validate(options).size(), 1U);
}

TEST(AngularVolume, KnowsTheDistanceBetweenNeighboursOnASparseGrid)
{
  const LightField light_field = field({{4, 0}, {4, 3}, {4, 8}});
  const auto volumes = extractVolumes(light_field, ViewSelection::Auto);
  ASSERT_EQ(volumes.size(), 1U);
  const auto& indices = volumes[0].view_indices;
  EXPECT_EQ(pairOf(light_field.views[indices[0]], light_field.views[indices[1]]).steps, cv::Point2d(3, 0));
  EXPECT_EQ(pairOf(light_field.views[indices[1]], light_field.views[indices[2]]).steps, cv::Point2d(5, 0));
}

TEST(AngularVolume, PairsViewsThatShareNoLine)
{
  const auto volumes = extractVolumes(field({{0, 0}, {1, 2}, {2, 1}}), ViewSelection::Auto);
  ASSERT_EQ(volumes.size(), 2U);
  EXPECT_EQ(volumes[0].view_indices.size(), 2U);
}

}  // namespace
}  // namespace light_field_depth
