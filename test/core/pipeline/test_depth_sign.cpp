#include "light_field_depth/core/depth_sign.h"

#include <gtest/gtest.h>

#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
/// Squares in front of a wall.
LightField squares()
{
  testing::SceneSettings settings;
  settings.size = {192, 144};
  settings.positions = testing::crossPositions(5, 5);
  settings.samples = 1;
  std::vector<testing::Surface> surfaces = {testing::plane(-1.5, 0.0, 0.0, testing::noiseTexture(1, 10.0))};
  for (int i = 0; i < 12; ++i)
  {
    const cv::Rect2d area(18.0 + 42.0 * (i % 4), 14.0 + 42.0 * (i / 4), 22.0, 24.0);
    surfaces.push_back(
        testing::rectangle(1.5, area, testing::noiseTexture(static_cast<std::uint32_t>(20 + i), 10.0)));
  }
  return testing::renderScene(surfaces, settings).light_field;
}

/// The views on the opposite side of the reference: every disparity changes its sign.
LightField turned(const LightField& light_field)
{
  std::vector<View> views;
  const GridPosition centre = light_field.reference().grid;
  for (const View& view : light_field.views)
  {
    views.push_back(
        gridView(2 * centre.row - view.grid.row, 2 * centre.column - view.grid.column, view.image));
  }
  return makeLightField(views, centre);
}

TEST(DepthSign, OcclusionsTellNearFromFar)
{
  ThreadPool pool(2);
  const LightField right = squares();
  const DepthSign sign = findDepthSign(right, pool);
  EXPECT_TRUE(sign.decided) << sign.votes << " " << sign.share << " " << sign.significance;
  EXPECT_FALSE(sign.reversed);
  EXPECT_GE(sign.votes, 8);
  EXPECT_GT(sign.share, 0.75);
  EXPECT_NEAR(sign.range.min, -1.5F, 0.1F);
  EXPECT_NEAR(sign.range.max, 1.5F, 0.1F);
  const DepthSign wrong = findDepthSign(turned(right), pool);
  EXPECT_TRUE(wrong.decided) << wrong.votes << " " << wrong.share << " " << wrong.significance;
  EXPECT_TRUE(wrong.reversed);
  EXPECT_LT(wrong.share, 0.25);
  EXPECT_LT(wrong.significance, -3.0);
}

TEST(DepthSign, ExposuresThatDifferDoNotChangeIt)
{
  ThreadPool pool(2);
  LightField uneven = squares();
  for (View& view : uneven.views)
  {
    // What lies to the left and above is dark, what lies to the right and below is bright.
    const double gain = 1.0 + 0.15 * (view.steps.x + view.steps.y);
    cv::Mat changed;
    view.image.convertTo(changed, -1, 0.75 * gain);
    view.image = changed;
  }
  const DepthSign sign = findDepthSign(uneven, pool);
  EXPECT_TRUE(sign.decided) << sign.votes << " " << sign.share << " " << sign.significance;
  EXPECT_FALSE(sign.reversed);
}

TEST(DepthSign, AFlatSceneTellsNothing)
{
  testing::SceneSettings settings;
  settings.size = {128, 96};
  settings.positions = testing::crossPositions(3, 3);
  settings.samples = 1;
  ThreadPool pool(2);
  const LightField flat =
      testing::renderScene({testing::plane(0.5, 0.0, 0.0, testing::noiseTexture(1, 10.0))}, settings)
          .light_field;
  const DepthSign sign = findDepthSign(flat, pool);
  EXPECT_FALSE(sign.decided);
  EXPECT_EQ(sign.votes, 0);
}

TEST(DepthSign, ViewsOnOneSideOnlyTellNothing)
{
  LightField right = squares();
  std::vector<View> views;
  for (const View& view : right.views)
  {
    if (view.steps.x >= 0.0 && view.steps.y >= 0.0)
    {
      views.push_back(view);
    }
  }
  ThreadPool pool(2);
  EXPECT_FALSE(findDepthSign(makeLightField(views, right.reference().grid), pool).decided);
}

}  // namespace
}  // namespace light_field_depth
