#include "core/multiview/maps/filled_regions.h"

#include <functional>

#include <gtest/gtest.h>

#include "core/multiview/refine/cell_sums.h"

namespace light_field_depth::multiview
{
namespace
{
const cv::Size CELLS(24, 16);
const cv::Size SIZE(CELLS.width* CELL_PX - 3, CELLS.height* CELL_PX - 1);

cv::Mat disparityOf(const std::function<double(int x, int y)>& value)
{
  cv::Mat disparity(SIZE, CV_32FC1);
  for (int y = 0; y < disparity.rows; ++y)
  {
    for (int x = 0; x < disparity.cols; ++x)
    {
      disparity.at<float>(y, x) = static_cast<float>(value(x, y));
    }
  }
  return disparity;
}

double slanted(int x, int y)
{
  return 0.5 + 0.01 * x - 0.004 * y;
}

/// Nothing is known in an area of cells.
cv::Mat blankIn(const cv::Rect& area)
{
  cv::Mat share(CELLS, CV_32FC1, cv::Scalar(1.0));
  share(area).setTo(0.0);
  return share;
}

double part(const cv::Mat& filled, const cv::Rect& cells)
{
  const cv::Rect pixels =
      cv::Rect(cells.x * CELL_PX, cells.y * CELL_PX, cells.width * CELL_PX, cells.height * CELL_PX) &
      cv::Rect({}, filled.size());
  return static_cast<double>(cv::countNonZero(filled(pixels))) / pixels.area();
}

TEST(FilledRegions, WhatIsKnownIsNotFilled)
{
  EXPECT_EQ(cv::countNonZero(findFilled(blankIn({}), disparityOf(slanted))), 0);
}

TEST(FilledRegions, ABlankPartOfAWallIsHeldByTheWall)
{
  const cv::Rect blank(6, 4, 10, 8);
  EXPECT_EQ(part(findFilled(blankIn(blank), disparityOf(slanted)), blank), 0.0);
  const cv::Mat unmeasured = findUnmeasured(blankIn(blank), SIZE);
  EXPECT_EQ(unmeasured.size(), SIZE);
  EXPECT_EQ(part(unmeasured, blank), 1.0);
  EXPECT_EQ(cv::countNonZero(unmeasured), blank.area() * CELL_PX * CELL_PX);
  // An object before a quarter of the outline does not matter; what the filling makes of it is not on the
  // wall.
  const auto with_object = [](int x, int y)
  { return slanted(x, y) + (y < 6 * CELL_PX && x < 12 * CELL_PX ? 1.0 : 0.0); };
  const cv::Mat filled = findFilled(blankIn(blank), disparityOf(with_object));
  EXPECT_EQ(part(filled, {6, 4, 6, 2}), 1.0);
  EXPECT_EQ(part(filled, {6, 6, 10, 6}), 0.0);
}

TEST(FilledRegions, ABlankHalfOfTheImageIsFilled)
{
  const cv::Rect half(0, 0, 12, 16);
  EXPECT_EQ(part(findFilled(blankIn(half), disparityOf(slanted)), half), 1.0);
  const cv::Rect all({}, CELLS);
  EXPECT_EQ(part(findFilled(blankIn(all), disparityOf(slanted)), all), 1.0);
}

TEST(FilledRegions, ABlankSpaceBetweenTwoSurfacesIsFilled)
{
  const cv::Rect between(6, 0, 10, 16);
  const auto ramp = [](int x, int /*y*/) {
    return x < 6 * CELL_PX ? 0.0 : x >= 16 * CELL_PX ? 2.0 : 2.0 * (x - 6 * CELL_PX) / (10.0 * CELL_PX);
  };
  // All that touches the space is on the plane of the ramp, but it goes on at neither side.
  EXPECT_EQ(part(findFilled(blankIn(between), disparityOf(ramp)), between), 1.0);
}

TEST(FilledRegions, AFewKnownPixelsHoldNothing)
{
  cv::Mat share = cv::Mat::zeros(CELLS, CV_32FC1);
  share.at<float>(8, 12) = 1.0F;
  EXPECT_GT(part(findFilled(share, disparityOf(slanted)), {0, 0, 24, 16}), 0.99);
}

}  // namespace
}  // namespace light_field_depth::multiview
