#include "ros/view_rectifier.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "expect_sentence.h"

namespace light_field_depth
{
namespace
{
using testing::expectSentence;

const cv::Size SIZE(160, 120);

sensor_msgs::CameraInfo camera()
{
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(SIZE.width);
  info.height = static_cast<std::uint32_t>(SIZE.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {150.0, 0.0, 79.0, 0.0, 150.0, 59.0, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {150.0, 0.0, 79.0, -15.0, 0.0, 150.0, 59.0, 7.5, 0.0, 0.0, 1.0, 0.0};
  return info;
}

/// The brightness in a direction: smooth, so that interpolation changes little.
double brightness(double x, double y)
{
  return 128.0 + 60.0 * std::sin(14.0 * x) + 50.0 * std::cos(11.0 * y + 3.0 * x);
}

/// The image that shows, at each pixel, what lies in the direction that `direction` gives.
template <class Direction>
cv::Mat render(const Direction& direction)
{
  cv::Mat image(SIZE, CV_8UC1);
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      const cv::Point2d at = direction(cv::Point2d(x, y));
      image.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(brightness(at.x, at.y));
    }
  }
  return image;
}

/// What the plane's camera sees.
cv::Mat ideal(const sensor_msgs::CameraInfo& info)
{
  return render(
      [&](const cv::Point2d& pixel)
      { return cv::Point2d((pixel.x - info.P[2]) / info.P[0], (pixel.y - info.P[6]) / info.P[5]); });
}

/// The mean difference away from the border, in levels.
double difference(const cv::Mat& a, const cv::Mat& b)
{
  const cv::Rect inside(20, 20, SIZE.width - 40, SIZE.height - 40);
  return cv::norm(a(inside), b(inside), cv::NORM_L1) / inside.area();
}

cv::Matx33d rotation(double angle_x, double angle_y)
{
  cv::Matx33d matrix;
  cv::Rodrigues(cv::Vec3d(angle_x, angle_y, 0.0), matrix);
  return matrix;
}

/// The direction in the turned frame of the plane that a raw pixel shows.
cv::Point2d turned(const cv::Matx33d& turn, const cv::Point2d& direction)
{
  const cv::Vec3d ray = turn * cv::Vec3d(direction.x, direction.y, 1.0);
  return {ray[0] / ray[2], ray[1] / ray[2]};
}

TEST(ViewRectifier, LeavesARectifiedImageAsItIs)
{
  const ViewRectifier rectifier(camera(), false, 150.0, "View (0, 0)");
  EXPECT_FALSE(rectifier.changesImage());
  const cv::Mat image = ideal(camera());
  EXPECT_EQ(rectifier.apply(image).data, image.data);
}

TEST(ViewRectifier, TakesDistortionAndRotationOutOfARawImage)
{
  for (const char* const model : {"plumb_bob", "rational_polynomial", "equidistant"})
  {
    sensor_msgs::CameraInfo info = camera();
    info.distortion_model = model;
    const bool fisheye = info.distortion_model == "equidistant";
    info.D = fisheye ? std::vector<double>{-0.1, 0.02, 0.0, 0.0}
                     : std::vector<double>{-0.2, 0.05, 1e-3, -1e-3, 0.0};
    if (info.distortion_model == "rational_polynomial")
    {
      info.D = {-0.2, 0.05, 1e-3, -1e-3, 0.0, 0.01, 0.0, 0.0};
    }
    const cv::Matx33d turn = rotation(0.02, -0.03);
    std::copy(turn.val, turn.val + 9, info.R.begin());
    const cv::Matx33d k(info.K.data());
    const cv::Mat raw = render(
        [&](const cv::Point2d& pixel)
        {
          std::vector<cv::Point2d> ray;
          const std::vector<cv::Point2d> pixels = {pixel};
          if (fisheye)
          {
            cv::fisheye::undistortPoints(pixels, ray, k, info.D);
          }
          else
          {
            cv::undistortPoints(pixels, ray, k, info.D);
          }
          return turned(turn, ray.front());
        });
    const ViewRectifier rectifier(info, true, 150.0, "View (0, 0)");
    ASSERT_TRUE(rectifier.changesImage());
    const cv::Mat expected = ideal(info);
    EXPECT_GT(difference(raw, expected), 10.0) << model;
    EXPECT_LT(difference(rectifier.apply(raw), expected), 1.0) << model;
  }
}

TEST(ViewRectifier, MakesUpForASmallDifferenceOfFocalLength)
{
  sensor_msgs::CameraInfo info = camera();
  info.P[0] = 152.0;
  info.P[3] = -15.2;
  info.P[5] = 148.0;
  info.P[7] = 7.4;
  const ViewRectifier rectifier(info, false, 150.0, "View (0, 0)");
  ASSERT_TRUE(rectifier.changesImage());
  const sensor_msgs::CameraInfo& plane = rectifier.rectified();
  EXPECT_DOUBLE_EQ(plane.P[0], 150.0);
  EXPECT_NEAR(-plane.P[3] / plane.P[0], 0.1, 1e-12) << "the camera stands where it stood";
  EXPECT_NEAR(-plane.P[7] / plane.P[5], -0.05, 1e-12);
  EXPECT_LT(difference(rectifier.apply(ideal(info)), ideal(plane)), 1.0);
}

TEST(ViewRectifier, MakesUpForASmallRotationInP)
{
  const cv::Matx33d turn = rotation(0.01, 0.02);
  const cv::Matx33d k(camera().K.data());
  const cv::Matx33d projection = k * turn;
  const cv::Vec3d translation = -(projection * cv::Vec3d(0.1, -0.05, 0.0));
  sensor_msgs::CameraInfo info = camera();
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      info.P[static_cast<std::size_t>(4 * row + column)] = projection(row, column);
    }
    info.P[static_cast<std::size_t>(4 * row + 3)] = translation[row];
  }
  const ViewRectifier rectifier(info, false, 150.0, "View (0, 0)");
  const sensor_msgs::CameraInfo& plane = rectifier.rectified();
  EXPECT_NEAR(-plane.P[3] / plane.P[0], 0.1, 1e-9);
  EXPECT_NEAR(-plane.P[7] / plane.P[5], -0.05, 1e-9);
  const cv::Matx33d back = turn.t() * k.inv();
  const cv::Mat seen = render(
      [&](const cv::Point2d& pixel)
      {
        const cv::Vec3d ray = back * cv::Vec3d(pixel.x, pixel.y, 1.0);
        return cv::Point2d(ray[0] / ray[2], ray[1] / ray[2]);
      });
  EXPECT_LT(difference(rectifier.apply(seen), ideal(plane)), 1.0);
}

TEST(ViewRectifier, RefusesWhatItCannotBringOntoThePlane)
{
  sensor_msgs::CameraInfo info = camera();
  info.distortion_model = "thin_prism";
  expectSentence([&] { ViewRectifier(info, true, 150.0, "View (1, 2)"); }, {"View (1, 2)", "thin_prism"});
  info = camera();
  info.D.assign(3, 0.0);
  expectSentence([&] { ViewRectifier(info, true, 150.0, "View (1, 2)"); }, {"3 coefficients"});
  info = camera();
  info.K[0] = 0.0;
  expectSentence([&] { ViewRectifier(info, true, 150.0, "View (1, 2)"); },
                 {"K of its CameraInfo", "calibrate"});
  info = camera();
  info.P[8] = 0.3;
  expectSentence([&] { ViewRectifier(info, false, 150.0, "View (1, 2)"); }, {"P[8]", "one plane"});
}

TEST(ViewRectifier, MasksWhatTheImageDoesNotReach)
{
  sensor_msgs::CameraInfo info = camera();
  const cv::Mat known(SIZE, CV_8UC1, cv::Scalar(255));
  EXPECT_TRUE(ViewRectifier(info, true, 150.0, "View").applyToMask({}).empty()) << "nothing is moved";
  // A plane's camera whose middle is 10 px further to the right shows 10 columns that the image does not
  // have.
  info.P[2] += 10.0;
  const ViewRectifier moved(info, true, 150.0, "View");
  const cv::Mat mask = moved.applyToMask({});
  ASSERT_EQ(mask.size(), SIZE);
  EXPECT_EQ(cv::countNonZero(mask.colRange(0, 10)), 0);
  EXPECT_EQ(cv::countNonZero(mask), (SIZE.width - 10) * SIZE.height);
  cv::Mat partly = known.clone();
  partly.colRange(0, 5).setTo(0);
  EXPECT_EQ(cv::countNonZero(moved.applyToMask(partly)), (SIZE.width - 15) * SIZE.height);
}

}  // namespace
}  // namespace light_field_depth
