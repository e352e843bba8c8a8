#include "evaluation/view_exchange.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
constexpr double MIN_SIGNIFICANCE = 4.0;

/// A row of five views of a rectangle before a plane.
testing::SyntheticLightField rowOfFive(double depth_px)
{
  testing::SceneSettings settings;
  settings.size = {160, 120};
  settings.positions = testing::gridPositions(1, 5);
  settings.samples = 2;
  return testing::renderScene(
      {testing::plane(0.3, 0.0, 0.0, testing::noiseTexture(6, 8.0)),
       testing::rectangle(0.3 + depth_px, {40.0, 20.0, 80.0, 80.0}, testing::noiseTexture(7, 8.0))},
      settings);
}

TEST(ViewExchange, FindsNeighboursThatChangedPlaces)
{
  ThreadPool pool(2);
  for (const double depth_px : {0.6, 6.0})
  {
    const testing::SyntheticLightField row = rowOfFive(depth_px);
    EXPECT_TRUE(findExchanges(row.light_field, row.truth, MIN_SIGNIFICANCE, pool).empty());
    for (const auto& [a, b] : {std::make_pair(0U, 1U), std::make_pair(3U, 4U)})
    {
      LightField exchanged = row.light_field;
      std::swap(exchanged.views[a].image, exchanged.views[b].image);
      const std::vector<ViewExchange> found = findExchanges(exchanged, row.truth, MIN_SIGNIFICANCE, pool);
      ASSERT_EQ(found.size(), 1U) << depth_px << " " << a;
      EXPECT_EQ(found.front().first, a);
      EXPECT_EQ(found.front().second, b);
      EXPECT_GT(found.front().significance, 2.0 * MIN_SIGNIFICANCE);
    }
  }
}

TEST(ViewExchange, FindsTheReferenceInThePlaceOfItsNeighbour)
{
  const testing::SyntheticLightField row = rowOfFive(1.0);
  LightField exchanged = row.light_field;
  ASSERT_EQ(exchanged.reference_index, 2U);
  std::swap(exchanged.views[2].image, exchanged.views[3].image);
  // The rectangle where the neighbour sees it.
  cv::Mat disparity(row.truth.size(), CV_32FC1, 0.3);
  disparity(cv::Rect(39, 20, 80, 80)).setTo(1.3);
  ThreadPool pool(2);
  const std::vector<ViewExchange> found = findExchanges(exchanged, disparity, MIN_SIGNIFICANCE, pool);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().first, 3U);
  EXPECT_EQ(found.front().second, 2U);
}

TEST(ViewExchange, AShiftOfTheWholeViewTellsNothing)
{
  const testing::SyntheticLightField row = rowOfFive(1.0);
  LightField shifted = row.light_field;
  shifted.views[3].offset_px -= cv::Point2d(0.8, 0.0);
  shifted.views[4].offset_px += cv::Point2d(0.8, 0.3);
  ThreadPool pool(2);
  EXPECT_TRUE(findExchanges(shifted, row.truth, MIN_SIGNIFICANCE, pool).empty());
}

/// Noise and an unknown unit make maps wider or narrower than what the views show.
TEST(ViewExchange, AMapThatIsTooWideOrTooNarrowTellsNothing)
{
  const testing::SyntheticLightField row = rowOfFive(1.0);
  ThreadPool pool(2);
  for (const double factor : {0.7, 1.4})
  {
    const cv::Mat map = row.truth * factor;
    EXPECT_TRUE(findExchanges(row.light_field, map, MIN_SIGNIFICANCE, pool).empty()) << factor;
  }
}

TEST(ViewExchange, AFlatSceneTellsNothing)
{
  LightField flat = rowOfFive(0.0).light_field;
  std::swap(flat.views[3].image, flat.views[4].image);
  ThreadPool pool(2);
  EXPECT_TRUE(findExchanges(flat, cv::Mat(flat.size(), CV_32FC1, 0.3), MIN_SIGNIFICANCE, pool).empty());
}

}  // namespace
}  // namespace light_field_depth
