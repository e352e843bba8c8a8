#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "core/multiview/maps/boundary_pixels.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int BORDER = 20;
constexpr float FAR_PX = -1.0F;
constexpr float NEAR_PX = 1.0F;

/// A bright near surface from a column on; the last column before it has some of its colour, and matching
/// gave it to the near surface.
struct Edge
{
  Edge(int share_percent, int contrast)
  {
    cv::Mat image(24, 40, CV_8UC1, 100);
    image.colRange(BORDER, 40).setTo(100 + contrast);
    image.col(BORDER - 1).setTo(100 + contrast * share_percent / 100);
    preparePlanar(image, {}, 4, guide);
    disparity = cv::Mat(24, 40, CV_32FC1, FAR_PX);
    disparity.colRange(BORDER - 1, 40).setTo(NEAR_PX);
  }

  float decided()
  {
    ThreadPool pool(2);
    cv::Mat scratch;
    decideBoundaryPixels(guide, {}, pool, disparity, scratch);
    return disparity.at<float>(12, BORDER - 1);
  }

  PlanarImage guide;
  cv::Mat disparity;
};

TEST(BoundaryPixels, OfTheBackgroundsColourGoToTheBackground)
{
  EXPECT_EQ(Edge(0, 60).decided(), FAR_PX);
  EXPECT_EQ(Edge(25, 60).decided(), FAR_PX);
}

TEST(BoundaryPixels, WithEnoughOfTheForegroundStayThere)
{
  EXPECT_EQ(Edge(40, 60).decided(), NEAR_PX);
  EXPECT_EQ(Edge(100, 60).decided(), NEAR_PX);
}

TEST(BoundaryPixels, StayWhereTheSidesHaveOneColour)
{
  EXPECT_EQ(Edge(0, 5).decided(), NEAR_PX);
}

TEST(BoundaryPixels, NothingElseMoves)
{
  Edge edge(0, 60);
  edge.decided();
  EXPECT_EQ(edge.disparity.at<float>(12, BORDER), NEAR_PX);
  EXPECT_EQ(edge.disparity.at<float>(12, BORDER - 2), FAR_PX);
}

}  // namespace
}  // namespace light_field_depth::multiview
