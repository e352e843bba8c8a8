#include <algorithm>
#include <cmath>
#include <iostream>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "core/multiview/refine/edge_aware_smoothing.h"
#include "core/multiview/refine/surface_slopes.h"

namespace light_field_depth::multiview
{
namespace
{
/// A plane, of which nothing is known at its right end.
struct HalfKnownPlane
{
  static constexpr int WIDTH = 121;
  static constexpr int HEIGHT = 83;
  static constexpr float ALONG_X = 0.004F;
  static constexpr float ALONG_Y = -0.003F;

  HalfKnownPlane() : truth(HEIGHT, WIDTH, CV_32FC1), weight(HEIGHT, WIDTH, CV_32FC1, cv::Scalar(50.0))
  {
    for (int y = 0; y < HEIGHT; ++y)
    {
      for (int x = 0; x < WIDTH; ++x)
      {
        truth.at<float>(y, x) = ALONG_X * static_cast<float>(x) + ALONG_Y * static_cast<float>(y);
      }
    }
    weight(end).setTo(0.0F);
  }

  cv::Rect end{101, 0, 20, HEIGHT};
  cv::Mat truth;
  cv::Mat weight;
};

TEST(SurfaceSlopes, APlaneHasItsSlopesEverywhere)
{
  const HalfKnownPlane plane;
  cv::Mat guide_left(plane.truth.size(), CV_32FC1, cv::Scalar(200.0));
  cv::Mat guide_above = guide_left.clone();
  guide_left.col(0).setTo(0.0F);
  guide_above.row(0).setTo(0.0F);
  ThreadPool pool(2);
  SurfaceSlopes slopes;
  slopes.find(plane.truth, plane.weight, guide_left, guide_above, {}, pool);
  for (int y = 0; y < HalfKnownPlane::HEIGHT; ++y)
  {
    for (int x = 0; x < HalfKnownPlane::WIDTH; ++x)
    {
      // A level surface counts for 0.2 %, more where nothing is known.
      ASSERT_NEAR(slopes.left(y)[x], HalfKnownPlane::ALONG_X, 0.05F * HalfKnownPlane::ALONG_X)
          << x << " " << y;
      ASSERT_NEAR(slopes.above(y)[x], HalfKnownPlane::ALONG_Y, -0.05F * HalfKnownPlane::ALONG_Y)
          << x << " " << y;
    }
    EXPECT_EQ(slopes.left(y)[HalfKnownPlane::WIDTH], 0.0F);
  }
}

/// Changes that nothing confirms say nothing: a surface is level there.
TEST(SurfaceSlopes, WhatIsNotKnownIsLevel)
{
  const HalfKnownPlane plane;
  const cv::Mat guide(plane.truth.size(), CV_32FC1, cv::Scalar(200.0));
  ThreadPool pool(1);
  SurfaceSlopes slopes;
  slopes.find(plane.truth, cv::Mat::zeros(plane.truth.size(), CV_32FC1), guide, guide, {}, pool);
  EXPECT_EQ(slopes.left(40)[60], 0.0F);
  EXPECT_EQ(slopes.above(40)[60], 0.0F);
}

/// Root mean square, px, where nothing is known.
double errorAtEnd(const HalfKnownPlane& plane, bool follow_slopes)
{
  cv::Mat image(plane.truth.size(), CV_8UC1, cv::Scalar(90));
  PlanarImage guide;
  ThreadPool pool(1);
  preparePlanar(image, {}, 8, guide);
  SmoothingSettings settings;
  settings.follow_slopes = follow_slopes;
  EdgeAwareSmoother smoother;
  smoother.setGuide(guide, settings, pool);
  cv::Mat disparity = plane.truth.clone();
  for (int x = plane.end.x; x < disparity.cols; ++x)
  {
    disparity.col(plane.end.x - 1).copyTo(disparity.col(x));
  }
  smoother.run(plane.weight, plane.truth, settings, pool, disparity);
  return cv::norm(disparity(plane.end), plane.truth(plane.end)) / std::sqrt(plane.end.area());
}

/// Level smoothing ends a slanted surface with a level piece where nothing is known.
TEST(SurfaceSlopes, SmoothingGoesOnWithTheSlope)
{
  const HalfKnownPlane plane;
  const double level = errorAtEnd(plane, false);
  const double sloping = errorAtEnd(plane, true);
  std::cout << level << " px level, " << sloping << " px sloping" << std::endl;
  EXPECT_LT(sloping, 0.022);
  EXPECT_GT(level, 0.05);
}

}  // namespace
}  // namespace light_field_depth::multiview
