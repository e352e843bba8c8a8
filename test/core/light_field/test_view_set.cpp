#include <vector>

#include <gtest/gtest.h>

#include "core/light_field/view_set.h"
#include "support/synthetic_scene.h"

namespace light_field_depth::multiview
{
namespace
{
TEST(ThinnedArms, KeepTheNearestTheFarthestAndTheReference)
{
  testing::SceneSettings settings;
  settings.size = {32, 32};
  settings.positions = testing::crossPositions(9, 9);
  const auto input = testing::renderScene(testing::standardScene(settings.size), settings);
  const LightField thinned = withThinnedArms(input.light_field, 2);
  ASSERT_EQ(thinned.views.size(), 9U);
  EXPECT_EQ(thinned.reference().grid, (GridPosition{4, 4}));
  std::vector<int> rows;
  for (const View& view : thinned.views)
  {
    rows.push_back(view.grid.row);
  }
  EXPECT_EQ(rows, (std::vector<int>{0, 3, 4, 4, 4, 4, 4, 5, 8}));
}

}  // namespace
}  // namespace light_field_depth::multiview
