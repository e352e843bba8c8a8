#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/light_field.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
std::vector<View> grid(int rows, int columns)
{
  std::vector<View> views;
  for (const GridPosition& p : testing::gridPositions(rows, columns))
  {
    views.push_back(gridView(p.row, p.column, cv::Mat(32, 48, CV_8UC3, cv::Scalar(1, 2, 3))));
  }
  return views;
}

std::string messageOf(const std::function<void()>& action)
{
  try
  {
    action();
  }
  catch (const InputError& error)
  {
    return error.what();
  }
  return "";
}

TEST(LightField, TakesTheMiddleViewAsReferenceAndMakesStepsRelativeToIt)
{
  const LightField field = makeLightField(grid(9, 9));
  EXPECT_EQ(field.reference().grid, (GridPosition{4, 4}));
  EXPECT_EQ(field.views.front().steps, cv::Point2d(-4, -4));
  EXPECT_EQ(field.reference().steps, cv::Point2d(0, 0));
}

TEST(LightField, DoesNotDependOnTheOrderOfTheViews)
{
  std::vector<View> reversed = grid(3, 5);
  std::reverse(reversed.begin(), reversed.end());
  const LightField a = makeLightField(grid(3, 5));
  const LightField b = makeLightField(reversed);
  EXPECT_EQ(a.reference_index, b.reference_index);
  for (std::size_t i = 0; i < a.views.size(); ++i)
  {
    EXPECT_EQ(a.views[i].grid, b.views[i].grid);
  }
}

TEST(LightField, TakesTheNamedReference)
{
  const LightField field = makeLightField(grid(3, 3), GridPosition{0, 2});
  EXPECT_EQ(field.reference().grid, (GridPosition{0, 2}));
  EXPECT_EQ(field.views.front().steps, cv::Point2d(-2, 0));
}

TEST(LightField, RefusesWhatCannotBeUsedInASentenceThatNamesTheView)
{
  EXPECT_NE(messageOf([] { makeLightField(grid(1, 1)); }).find("1 view"), std::string::npos);
  EXPECT_NE(messageOf(
                [] {
                  makeLightField(grid(3, 3), GridPosition{7, 0});
                })
                .find("(7, 0)"),
            std::string::npos);

  std::vector<View> twice = grid(2, 2);
  twice.push_back(twice.front());
  EXPECT_NE(messageOf([&] { makeLightField(twice); }).find("(0, 0) occurs twice"), std::string::npos);

  std::vector<View> sizes = grid(2, 2);
  sizes[3].image = cv::Mat(31, 48, CV_8UC3);
  EXPECT_NE(messageOf([&] { makeLightField(sizes); }).find("View (1, 1) has an image of 48 x 31"),
            std::string::npos);

  std::vector<View> types = grid(2, 2);
  types[2].image = cv::Mat(32, 48, CV_32FC1);
  EXPECT_NE(messageOf([&] { makeLightField(types); }).find("View (1, 0)"), std::string::npos);

  std::vector<View> empty = grid(2, 2);
  empty[1].image = cv::Mat();
  EXPECT_NE(messageOf([&] { makeLightField(empty); }).find("View (0, 1) has an empty image"),
            std::string::npos);

  Calibration calibration;
  EXPECT_NE(messageOf([&] { makeLightField(grid(2, 2), std::nullopt, calibration); }).find("focal_length_px"),
            std::string::npos);

  std::vector<View> together = grid(1, 2);
  together[1].steps = together[0].steps;
  EXPECT_NE(messageOf([&] { makeLightField(together); }).find("position"), std::string::npos);
}

TEST(SelectViews, KeepsTheShapeThatIsNamed)
{
  const LightField field = makeLightField(grid(5, 5));
  EXPECT_EQ(selectViews(field, ViewSelection::Row).views.size(), 5U);
  EXPECT_EQ(selectViews(field, ViewSelection::Column).views.size(), 5U);
  EXPECT_EQ(selectViews(field, ViewSelection::Cross).views.size(), 9U);
  EXPECT_EQ(selectViews(field, ViewSelection::Star).views.size(), 17U);
  EXPECT_EQ(selectViews(field, ViewSelection::All).views.size(), 25U);
  EXPECT_EQ(selectViews(field, ViewSelection::Cross).reference().grid, (GridPosition{2, 2}));
}

TEST(SelectViews, RefusesASelectionThatLeavesNothing)
{
  const LightField row = makeLightField(grid(1, 3));
  EXPECT_THROW(selectViews(row, ViewSelection::Column), InputError);
  EXPECT_THROW(viewSelectionFromString("diagonal"), InputError);
  EXPECT_EQ(viewSelectionFromString(toString(ViewSelection::Star)), ViewSelection::Star);
}

TEST(LightField, RefusesASelectionWhoseViewsStandAtOnePlace)
{
  std::vector<View> views;
  for (const cv::Point& place : {cv::Point(0, 0), cv::Point(1, 0), cv::Point(0, 1)})
  {
    View view = gridView(place.y, place.x, cv::Mat(20, 20, CV_8UC1, cv::Scalar(7)));
    view.steps = {1.0 * place.x, 0.0};
    views.push_back(view);
  }
  const LightField light_field = makeLightField(views, GridPosition{0, 0});
  EXPECT_EQ(selectViews(light_field, ViewSelection::Row).views.size(), 2U);
  EXPECT_THROW(selectViews(light_field, ViewSelection::Column), InputError);
}

}  // namespace
}  // namespace light_field_depth
