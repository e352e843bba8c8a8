#include "light_field_depth/ros/result_messages.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl_conversions/pcl_conversions.h>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/geometry.h"

namespace light_field_depth
{
namespace
{
std_msgs::Header header()
{
  std_msgs::Header result;
  result.stamp = ros::Time(12, 34);
  result.frame_id = "optical";
  return result;
}

Calibration calibration()
{
  Calibration result;
  result.focal_length_px = 400.0;
  result.baseline_m = 0.25;
  result.disparity_offset_px = 3.0;
  return result;
}

DisparityEstimate estimate()
{
  DisparityEstimate result;
  result.disparity = (cv::Mat_<float>(2, 3) << -2.0F, -1.0F, 0.0F, 1.0F, 2.0F, -3.5F);
  result.confidence = (cv::Mat_<float>(2, 3) << 1.0F, 0.1F, 1.0F, 1.0F, 0.9F, 1.0F);
  result.range = {-2.5F, 2.5F};
  return result;
}

float value(const sensor_msgs::Image& image, int y, int x)
{
  const cv::Mat view(static_cast<int>(image.height), static_cast<int>(image.width), CV_32FC1,
                     const_cast<std::uint8_t*>(image.data.data()), image.step);
  return view.at<float>(y, x);
}

TEST(DisparityMessage, GivesTheTrueDepthToAnyConsumer)
{
  const auto message = disparityMessage(header(), estimate(), calibration(), 0.0F, false);
  EXPECT_EQ(message->header.frame_id, "optical");
  EXPECT_EQ(message->image.header.stamp, ros::Time(12, 34));
  EXPECT_EQ(message->image.encoding, "32FC1");
  EXPECT_EQ(message->image.step, 12U);
  EXPECT_GT(message->T, 0.0F);
  for (int x = 0; x < 3; ++x)
  {
    EXPECT_NEAR(message->f * message->T / value(message->image, 0, x),
                depthFromDisparity(estimate().disparity.at<float>(0, x), calibration()), 1e-4);
  }
}

TEST(DisparityMessage, MarksWhatIsInvalidBelowTheMinimum)
{
  const auto message = disparityMessage(header(), estimate(), calibration(), 0.5F, false);
  EXPECT_FLOAT_EQ(message->min_disparity, 0.5F);
  EXPECT_FLOAT_EQ(message->max_disparity, 5.5F);
  EXPECT_FLOAT_EQ(value(message->image, 0, 1), message->min_disparity - 1.0F) << "not trusted";
  EXPECT_FLOAT_EQ(value(message->image, 1, 2), message->min_disparity - 1.0F) << "behind the camera";
  EXPECT_FLOAT_EQ(value(message->image, 1, 1), 5.0F);
}

TEST(DisparityMessage, HasAMinimumOfFiniteDepthAndAWindowOfTheWholeImage)
{
  DisparityEstimate parallel = estimate();
  Calibration unsheared = calibration();
  unsheared.disparity_offset_px = 0.0;
  const auto message = disparityMessage(header(), parallel, unsheared, 0.0F, false);
  EXPECT_GT(message->min_disparity, 0.0F);
  EXPECT_GT(message->delta_d, 0.0F);
  EXPECT_EQ(message->valid_window.width, 3U);
  EXPECT_EQ(message->valid_window.height, 2U);
  parallel.disparity.setTo(std::numeric_limits<float>::quiet_NaN());
  const auto nothing = disparityMessage(header(), parallel, unsheared, 0.0F, false);
  EXPECT_TRUE(std::isfinite(nothing->min_disparity) && std::isfinite(nothing->max_disparity));
  EXPECT_LT(value(nothing->image, 0, 0), nothing->min_disparity);
}

TEST(FloatImageMessage, KeepsEveryValue)
{
  const auto message = floatImageMessage(header(), estimate().disparity);
  EXPECT_EQ(message->encoding, "32FC1");
  EXPECT_EQ(message->data.size(), 24U);
  EXPECT_FLOAT_EQ(value(*message, 1, 2), -3.5F);
}

TEST(DisparityColorMessage, GoesFromBlueToRed)
{
  const auto message = disparityColorMessage(header(), estimate());
  EXPECT_EQ(message->encoding, "bgr8");
  const auto pixel = [&](int index) { return &message->data[static_cast<std::size_t>(index) * 3]; };
  EXPECT_GT(pixel(0)[0], pixel(0)[2]) << "the far pixel is more blue than red";
  EXPECT_GT(pixel(4)[2], pixel(4)[0]) << "the near pixel is more red than blue";
}

std::vector<ColoredPoint> points()
{
  constexpr float NaN = std::numeric_limits<float>::quiet_NaN();
  return {{1.0F, 2.0F, 3.0F, 10, 20, 30, 0, 0.5F}, {NaN, NaN, NaN, 0, 0, 0, 0, 0.0F}};
}

TEST(CloudMessages, AreWhatPclReads)
{
  sensor_msgs::PointCloud2 message;
  message.fields.resize(7);  // of whatever it held before
  message.data.resize(1000, 77);
  const std::vector<ColoredPoint> written = points();
  std::copy(written.begin(), written.end(), shapeOrganizedCloud(header(), {2, 1}, message));
  EXPECT_EQ(message.header.frame_id, header().frame_id);
  ASSERT_EQ(message.fields.size(), 5U);
  EXPECT_EQ(message.fields[4].name, "confidence");
  EXPECT_EQ(message.fields[4].offset, 16U);
  EXPECT_EQ(message.point_step, 20U);
  EXPECT_EQ(message.row_step, 40U);
  EXPECT_EQ(message.data.size(), 40U);
  EXPECT_FALSE(message.is_dense);
  pcl::PointCloud<pcl::PointXYZRGB> cloud;
  pcl::fromROSMsg(message, cloud);
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_FLOAT_EQ(cloud[0].y, 2.0F);
  EXPECT_EQ(cloud[0].b, 10);
  EXPECT_EQ(cloud[0].g, 20);
  EXPECT_EQ(cloud[0].r, 30);
  EXPECT_TRUE(std::isnan(cloud[1].x));
}

TEST(CloudMessages, OfTheDenseCloudAreUnorganised)
{
  sensor_msgs::PointCloud2 message;
  beginDenseCloud(header(), message);
  EXPECT_EQ(message.data.size(), 0U);
  std::vector<DensePoint> points(5);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i].z = static_cast<float>(i);
    points[i].r = 7;
    points[i].confidence = 0.25F;
  }
  appendDensePoints(points.data(), 3, 1, message);
  appendDensePoints(points.data(), 5, 2, message);
  EXPECT_EQ(message.height, 1U);
  EXPECT_EQ(message.width, 6U);
  EXPECT_EQ(message.row_step, 6U * 20U);
  EXPECT_EQ(message.data.size(), 6U * 20U);
  EXPECT_TRUE(message.is_dense);
  const auto* const kept = reinterpret_cast<const ColoredPoint*>(message.data.data());
  EXPECT_EQ(kept[2].z, 2.0F);
  EXPECT_EQ(kept[4].z, 2.0F) << "the second that was kept of five";
  EXPECT_EQ(kept[5].z, 4.0F);
  EXPECT_EQ(kept[5].r, 7);
  EXPECT_EQ(kept[5].confidence, 0.25F);
}

TEST(CloudMessages, AreThinnedToWhatRosTransports)
{
  EXPECT_EQ(thinningOfDenseCloud(0), 0U);
  EXPECT_EQ(thinningOfDenseCloud(1), 1U);
  EXPECT_EQ(thinningOfDenseCloud(50000000), 1U);
  EXPECT_EQ(thinningOfDenseCloud(50000001), 2U);
}

TEST(DisparityMessage, TheValidWindowBoundsWhatIsNotMasked)
{
  DisparityEstimate masked = estimate();
  EXPECT_EQ(disparityMessage(header(), masked, calibration(), 0.0F, false)->valid_window.width, 3U);
  masked.disparity.col(0).setTo(std::nanf(""));
  const auto message = disparityMessage(header(), masked, calibration(), 0.0F, false);
  EXPECT_EQ(message->valid_window.x_offset, 1U);
  EXPECT_EQ(message->valid_window.width, 2U);
  EXPECT_EQ(message->valid_window.height, 2U);
  EXPECT_LT(value(message->image, 0, 0), message->min_disparity);
  const auto colours = disparityColorMessage(header(), masked);
  EXPECT_EQ(colours->data[0] + colours->data[1] + colours->data[2], 0) << "black";
}

}  // namespace
}  // namespace light_field_depth
