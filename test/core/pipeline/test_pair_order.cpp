#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/pair_order.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
/// Two parallel cameras: disparities of 6 to 14 pixels.
LightField parallelPair(int columns_apart = 1, bool above_each_other = false)
{
  testing::SceneSettings settings;
  settings.size = {160, 120};
  settings.positions = above_each_other ? std::vector<GridPosition>{{0, 0}, {columns_apart, 0}}
                                        : std::vector<GridPosition>{{0, 0}, {0, columns_apart}};
  settings.samples = 1;
  const std::vector<testing::Surface> surfaces = {
      testing::plane(6.0, 0.0, 0.0, testing::noiseTexture(1, 8.0)),
      testing::rectangle(14.0, {40.0, 30.0, 60.0, 50.0}, testing::noiseTexture(2, 8.0))};
  LightField pair = testing::renderScene(surfaces, settings).light_field;
  return makeLightField(pair.views, GridPosition{0, 0});
}

LightField swapped(LightField pair)
{
  std::swap(pair.views[0].image, pair.views[1].image);
  return pair;
}

TEST(PairOrder, TellsARightPairFromASwappedOne)
{
  for (const bool above : {false, true})
  {
    ThreadPool pool(1);
    const LightField pair = parallelPair(1, above);
    const PairOrder right = findPairOrder(pair, pool);
    EXPECT_TRUE(right.decided) << right.right_share << " " << right.swapped_share;
    EXPECT_FALSE(right.swapped);
    EXPECT_GT(right.right_share, 0.7);
    const PairOrder wrong = findPairOrder(swapped(pair), pool);
    EXPECT_TRUE(wrong.decided) << wrong.right_share << " " << wrong.swapped_share;
    EXPECT_TRUE(wrong.swapped);
  }
}

TEST(PairOrder, SaysNothingOfMoreViewsAndOfViewsThatDoNotMove)
{
  ThreadPool pool(1);
  LightField same = parallelPair();
  same.views[1].image = same.views[0].image;
  EXPECT_FALSE(findPairOrder(same, pool).decided);
  LightField three = parallelPair();
  three.views.push_back(gridView(0, 2, three.views[0].image));
  EXPECT_FALSE(findPairOrder(three, pool).decided);
}

}  // namespace
}  // namespace light_field_depth
