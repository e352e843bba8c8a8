#include "light_field_depth/core/view_places.h"

#include <gtest/gtest.h>

#include <utility>

#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
const LightField& scene()
{
  static const LightField rendered = []
  {
    testing::SceneSettings settings;
    settings.size = {192, 144};
    settings.positions = testing::gridPositions(3, 5);
    settings.samples = 1;
    std::vector<testing::Surface> surfaces = {
        testing::plane(-4.0, 0.02, 0.01, testing::noiseTexture(1, 16.0))};
    for (int i = 0; i < 6; ++i)
    {
      const cv::Rect2d area(14.0 + 60.0 * (i % 3), 12.0 + 66.0 * (i / 3), 40.0, 44.0);
      surfaces.push_back(testing::rectangle(
          2.0 + 0.5 * i, area, testing::noiseTexture(20U + static_cast<std::uint32_t>(i), 16.0)));
    }
    return testing::renderScene(surfaces, settings).light_field;
  }();
  return rendered;
}

TEST(ViewPlaces, DoubtsNothingWhereAllIsRight)
{
  ThreadPool pool(2);
  const ViewPlaces places = checkViewPlaces(scene(), pool);
  EXPECT_TRUE(places.checked);
  EXPECT_TRUE(places.doubts.empty());
  EXPECT_FALSE(places.shuffled);
  EXPECT_GT(places.median_cost, 0.0);
  EXPECT_LT(places.median_cost, 0.3);
}

TEST(ViewPlaces, NamesTwoViewsThatChangedPlaces)
{
  LightField swapped = scene();
  std::swap(swapped.views[0].image, swapped.views[14].image);  // opposite corners
  ThreadPool pool(2);
  const ViewPlaces places = checkViewPlaces(swapped, pool);
  ASSERT_EQ(places.doubts.size(), 2U);
  EXPECT_EQ(places.doubts[0].view_index, 0U);
  EXPECT_EQ(places.doubts[0].kind, ViewDoubt::Kind::Misplaced);
  EXPECT_EQ(places.doubts[0].better_place, (GridPosition{2, 4}));
  EXPECT_GT(places.doubts[0].cost, 1.6 * places.doubts[0].best_cost);
  EXPECT_EQ(places.doubts[1].view_index, 14U);
  EXPECT_EQ(places.doubts[1].better_place, (GridPosition{0, 0}));
}

TEST(ViewPlaces, NamesAViewOfAnotherScene)
{
  LightField foreign = scene();
  cv::RNG random(8);
  cv::Mat other(foreign.size(), CV_8UC3);
  random.fill(other, cv::RNG::UNIFORM, 0, 256);
  foreign.views[5].image = other;
  ThreadPool pool(2);
  const ViewPlaces places = checkViewPlaces(foreign, pool);
  ASSERT_EQ(places.doubts.size(), 1U);
  EXPECT_EQ(places.doubts[0].view_index, 5U);
  EXPECT_EQ(places.doubts[0].kind, ViewDoubt::Kind::Foreign);
  EXPECT_GT(places.doubts[0].best_cost, 0.65);
}

TEST(ViewPlaces, KnowsWhenTheReferenceIsTheOne)
{
  LightField wrong = scene();
  std::swap(wrong.views[7].image, wrong.views[4].image);  // the reference and a corner
  ThreadPool pool(2);
  const ViewPlaces places = checkViewPlaces(wrong, pool);
  ASSERT_TRUE(places.checked);
  EXPECT_FALSE(places.shuffled);
  ASSERT_EQ(places.doubts.size(), 2U);
  EXPECT_EQ(places.doubts[0].view_index, 4U);
  EXPECT_EQ(places.doubts[1].view_index, 7U);
}

TEST(ViewPlaces, KnowsWhenTheOrderIsLost)
{
  // All but the reference and its four neighbours, which give the points their disparities.
  const std::vector<std::size_t> others = {0, 1, 3, 4, 5, 9, 10, 11, 13, 14};
  LightField shuffled = scene();
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    shuffled.views[others[i]].image = scene().views[others[(i + 3) % others.size()]].image;
  }
  ThreadPool pool(2);
  const ViewPlaces places = checkViewPlaces(shuffled, pool);
  EXPECT_TRUE(places.shuffled);
  EXPECT_GE(places.doubts.size(), 6U) << "0.4 of 14";
}

TEST(ViewPlaces, ThreeViewsAreTooFew)
{
  LightField few = scene();
  few.views.resize(3);
  few.reference_index = 1;
  ThreadPool pool(1);
  EXPECT_FALSE(checkViewPlaces(few, pool).checked);
}

}  // namespace
}  // namespace light_field_depth
