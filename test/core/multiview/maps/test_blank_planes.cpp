#include "core/multiview/maps/blank_planes.h"

#include <functional>

#include <gtest/gtest.h>

#include "core/multiview/refine/cell_sums.h"

namespace light_field_depth::multiview
{
namespace
{
const cv::Size CELLS(32, 24);
const cv::Size SIZE(CELLS.width* CELL_PX - 3, CELLS.height* CELL_PX - 1);
const cv::Rect BLANK(8, 6, 14, 10);  // cells
constexpr float KNOWN = 0.9F;

float wall(int x, int y)
{
  return 0.5F + 0.01F * static_cast<float>(x) - 0.004F * static_cast<float>(y);
}

/// A blank part of a wall, in which the map is not on it.
struct BlankWall
{
  BlankWall() : share(CELLS, CV_32FC1, cv::Scalar(1.0)), disparity(SIZE, CV_32FC1), confidence(SIZE, CV_32FC1)
  {
    share(BLANK).setTo(0.0);
    confidence.setTo(KNOWN);
    confidence(pixels()).setTo(0.0);
    image.create(SIZE.width, SIZE.height, 3, 8);
    paint([](int, int) { return 200; });
    put(wall);
    disparity(pixels()) += 0.2;
  }

  static cv::Rect pixels()
  {
    return {BLANK.x * CELL_PX, BLANK.y * CELL_PX, BLANK.width * CELL_PX, BLANK.height * CELL_PX};
  }

  void put(const std::function<float(int x, int y)>& value)
  {
    for (int y = 0; y < SIZE.height; ++y)
    {
      for (int x = 0; x < SIZE.width; ++x)
      {
        disparity.at<float>(y, x) = value(x, y);
      }
    }
  }

  void paint(const std::function<int(int x, int y)>& level)
  {
    for (int y = 0; y < SIZE.height; ++y)
    {
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        for (int x = 0; x < SIZE.width; ++x)
        {
          image.row(y)[channel * image.channelStride() + static_cast<std::size_t>(x)] =
              static_cast<std::uint8_t>(level(x, y));
        }
      }
    }
  }

  /// How many pixels are held.
  int hold() { return cv::countNonZero(held = holdBlankPlanes(share, image, {}, disparity, confidence)); }

  cv::Mat share;
  cv::Mat disparity;
  cv::Mat confidence;
  PlanarImage image;
  cv::Mat held;
};

TEST(BlankPlanes, ABlankPartOfAWallGoesToItsPlane)
{
  BlankWall scene;
  EXPECT_EQ(scene.hold(), BlankWall::pixels().area());
  EXPECT_EQ(cv::countNonZero(scene.held(BlankWall::pixels())), BlankWall::pixels().area());
  for (int y = 0; y < SIZE.height; ++y)
  {
    for (int x = 0; x < SIZE.width; ++x)
    {
      ASSERT_NEAR(scene.disparity.at<float>(y, x), wall(x, y), 1e-4) << x << ", " << y;
      ASSERT_EQ(scene.confidence.at<float>(y, x),
                BlankWall::pixels().contains({x, y}) ? BlankPlaneSettings().confidence : KNOWN);
    }
  }
}

TEST(BlankPlanes, WhatStandsBeforeAWallDoesNotMoveItsPlane)
{
  // A third of what is known around is nearer, though it has the colour of the wall.
  BlankWall scene;
  const cv::Rect object(0, 0, SIZE.width, BlankWall::pixels().y);
  scene.disparity(object) += 0.5;
  EXPECT_EQ(scene.hold(), BlankWall::pixels().area());
  const cv::Point middle(60, 44);
  EXPECT_NEAR(scene.disparity.at<float>(middle), wall(middle.x, middle.y), 1e-4);
}

TEST(BlankPlanes, APlaneThatSomethingIsSeenBehindHoldsNothing)
{
  BlankWall scene;
  const cv::Rect behind(0, 0, SIZE.width, BlankWall::pixels().y);
  scene.disparity(behind) -= 0.5;
  const cv::Mat before = scene.disparity.clone();
  EXPECT_EQ(scene.hold(), 0);
  EXPECT_EQ(cv::norm(before, scene.disparity, cv::NORM_INF), 0.0);
}

TEST(BlankPlanes, WhatIsShadedOrOfAnotherColourOrCurvedIsNotHeld)
{
  BlankWall shaded;
  shaded.paint([](int x, int /*y*/) { return 100 + x; });
  EXPECT_EQ(shaded.hold(), 0) << "as a ball";
  BlankWall sky;
  sky.paint([](int x, int y) { return BlankWall::pixels().contains({x, y}) ? 250 : 120; });
  EXPECT_EQ(sky.hold(), 0) << "as the sky above a house";
  BlankWall curved;
  curved.put([](int x, int y)
             { return 0.001F * static_cast<float>((x - 60) * (x - 60) + (y - 44) * (y - 44)); });
  EXPECT_EQ(curved.hold(), 0);
}

TEST(BlankPlanes, LittleThatIsKnownHoldsNothing)
{
  BlankWall unsure;
  unsure.confidence.setTo(0.3);
  EXPECT_EQ(unsure.hold(), 0);
  BlankWall small;
  small.share.setTo(1.0);
  small.share(cv::Rect(8, 6, 6, 6)).setTo(0.0);
  EXPECT_EQ(small.hold(), 0);
  BlankWall all;
  all.share.setTo(0.0);
  EXPECT_EQ(all.hold(), 0);
}

}  // namespace
}  // namespace light_field_depth::multiview
