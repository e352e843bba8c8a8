#include "core/preprocess/search_bounds.h"

#include <gtest/gtest.h>

#include "core/preprocess/sweep_views.h"

namespace light_field_depth
{
namespace
{
constexpr float MAX_DISPLACEMENT_PX = 48.0F;
constexpr float LABEL_STEP = 1.0F;

LightField viewsInARow(int views)
{
  std::vector<View> row;
  for (int column = 0; column < views; ++column)
  {
    row.push_back(gridView(0, column, cv::Mat(100, 200, CV_8UC1, cv::Scalar(0))));
  }
  return makeLightField(row, GridPosition{0, 0});
}

TEST(SearchBounds, TwoViewsAreAPair)
{
  const LightField two = viewsInARow(2);
  const LightField three = viewsInARow(3);
  EXPECT_TRUE(isPair(axisArmsOf(two)));
  EXPECT_FALSE(isPair(axisArmsOf(three)));
}

TEST(SearchBounds, ArraysBeginWithTheSameDisplacementEitherWay)
{
  const LightField three = viewsInARow(3);
  const SearchBounds bounds(axisArmsOf(three), MAX_DISPLACEMENT_PX, LABEL_STEP);
  EXPECT_FLOAT_EQ(bounds.range().min, -48.0F);
  EXPECT_FLOAT_EQ(bounds.range().max, 48.0F);
}

TEST(SearchBounds, PairsBeginWithAQuarterOfTheImageAndHardlyAnythingBehindInfinity)
{
  const LightField two = viewsInARow(2);
  const SearchBounds bounds(axisArmsOf(two), MAX_DISPLACEMENT_PX, LABEL_STEP);
  EXPECT_FLOAT_EQ(bounds.range().min, -3.0F);
  EXPECT_FLOAT_EQ(bounds.range().max, 50.0F);
}

TEST(SearchBounds, OnlyTheSideThatIsReachedOpensUpToTheLastThirdOfAView)
{
  const LightField three = viewsInARow(3);
  SearchBounds bounds(axisArmsOf(three), MAX_DISPLACEMENT_PX, LABEL_STEP);
  EXPECT_FALSE(bounds.widenFor({-46.9F, 46.9F}, LABEL_STEP));
  EXPECT_TRUE(bounds.widenFor({-3.0F, 47.0F}, LABEL_STEP));
  EXPECT_FLOAT_EQ(bounds.range().min, -48.0F);
  EXPECT_FLOAT_EQ(bounds.range().max, 140.0F);  // 0.7 of 200 pixels
  EXPECT_FALSE(bounds.widenFor({-3.0F, 140.0F}, LABEL_STEP)) << "nothing is left to open";
}

TEST(SearchBounds, TheFarSideOfAPairOpensInTwoSteps)
{
  const LightField two = viewsInARow(2);
  SearchBounds bounds(axisArmsOf(two), MAX_DISPLACEMENT_PX, LABEL_STEP);
  EXPECT_TRUE(bounds.widenFor({-2.5F, 10.0F}, LABEL_STEP));
  EXPECT_FLOAT_EQ(bounds.range().min, -48.0F);
  EXPECT_TRUE(bounds.widenFor({-48.0F, 10.0F}, LABEL_STEP));
  EXPECT_FLOAT_EQ(bounds.range().min, -140.0F);
  EXPECT_FLOAT_EQ(bounds.range().max, 50.0F);
}

}  // namespace
}  // namespace light_field_depth
