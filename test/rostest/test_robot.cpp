// What a robot asks of the node besides its results.

#include <cmath>
#include <filesystem>
#include <limits>

#include <cv_bridge/cv_bridge.h>
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <stereo_msgs/DisparityImage.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include "array_fixture.h"
#include "light_field_depth/LightFieldDepthStats.h"
#include "light_field_depth/nodelets/result_saver.h"
#include "support/temporary_folder.h"

namespace light_field_depth::testing
{
namespace
{
using RobotTest = ArrayFixture;
using CloudListener = Listener<sensor_msgs::PointCloud2>;
using ImageListener = Listener<sensor_msgs::Image>;
using StatsListener = Listener<LightFieldDepthStats>;

const cv::Size SMALL(64, 48);

cv::Mat pixelsOf(const sensor_msgs::Image& image)
{
  return cv_bridge::toCvCopy(image)->image;
}

std::string trigger(const ros::NodeHandle& node, const std::string& service, bool expected = true)
{
  std_srvs::Trigger call;
  EXPECT_TRUE(ros::service::call(node.resolveName(service), call));
  EXPECT_EQ(call.response.success != 0, expected) << call.response.message;
  return call.response.message;
}

void pause(const ros::NodeHandle& node, bool paused)
{
  std_srvs::SetBool call;
  call.request.data = paused ? 1 : 0;
  EXPECT_TRUE(ros::service::call(node.resolveName("pause"), call));
}

TEST_F(RobotTest, HasDepthInMillimetresAndConfidenceAsIntensity)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(3, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const ImageListener depth(*node_space_, "depth");
  const ImageListener depth_mm(*node_space_, "depth_mm");
  const ImageListener confidence(*node_space_, "confidence_mono8");
  ASSERT_TRUE(publishUntil(
      array, [&] { return depth.count() > 0 && depth_mm.count() > 0 && confidence.count() > 0; }));
  const cv::Mat metres = pixelsOf(*depth.all().front());
  const cv::Mat millimetres = pixelsOf(*depth_mm.all().front());
  ASSERT_EQ(millimetres.type(), CV_16UC1);
  EXPECT_EQ(confidence.newest()->encoding, "mono8");
  if (depth.all().front()->header.stamp == depth_mm.all().front()->header.stamp)
  {
    for (int x = 0; x < SMALL.width; ++x)
    {
      const float expected = metres.at<float>(24, x) * 1000.0F;
      EXPECT_NEAR(millimetres.at<std::uint16_t>(24, x), std::isfinite(expected) ? expected : 0.0F, 0.51);
    }
  }
}

TEST_F(RobotTest, GetsCloudsInItsOwnFrame)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("target_frame", std::string("robot_base"));
  startNode(scene.light_field);
  const CloudListener points2(*node_space_, "points2");
  const ImageListener depth(*node_space_, "depth");
  const Listener<diagnostic_msgs::DiagnosticArray> diagnostics(*array_space_, "/diagnostics");
  EXPECT_TRUE(publishUntil(
      array, [&] { return depth.count() > 0 && diagnosed(diagnostics, {"target_frame 'robot_base'"}); }))
      << "tf does not know it";
  EXPECT_EQ(points2.count(), 0U);

  tf2_ros::StaticTransformBroadcaster broadcaster;
  geometry_msgs::TransformStamped camera;
  camera.header.frame_id = "robot_base";
  camera.child_frame_id = "array_optical_frame";
  camera.transform.translation.z = 10.0;
  camera.transform.rotation.w = 1.0;
  broadcaster.sendTransform(camera);
  ASSERT_TRUE(publishUntil(array, [&] { return points2.count() > 0; }));
  EXPECT_EQ(points2.newest()->header.frame_id, "robot_base");
  sensor_msgs::PointCloud2ConstIterator<float> z(*points2.newest(), "z");
  EXPECT_GT(*z, 10.0F);
}

TEST_F(RobotTest, KnowsWhereTheViewsAre)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("publish_tf", true);
  startNode(scene.light_field);
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  const StatsListener stats(*node_space_, "stats");
  const std::string right = "array_optical_frame_view_0_2";
  ASSERT_TRUE(
      publishUntil(array, [&] { return buffer.canTransform("array_optical_frame", right, ros::Time(0)); }));
  const auto transform = buffer.lookupTransform("array_optical_frame", right, ros::Time(0));
  EXPECT_NEAR(transform.transform.translation.x, scene.light_field.calibration->baseline_m, 1e-9);
}

TEST_F(RobotTest, SeesNothingBeyondItsLimits)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(3, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  double farthest = 0.0;
  double nearest = 0.0;
  {
    startNode(scene.light_field);
    const ImageListener depth(*node_space_, "depth");
    ASSERT_TRUE(publishUntil(array, [&] { return depth.count() > 0; }));
    cv::Mat metres = pixelsOf(*depth.newest());
    cv::patchNaNs(metres, 1.0);
    cv::minMaxIdx(metres, &nearest, &farthest);
    node_.reset();
  }
  const double limit = 0.5 * (nearest + farthest);
  setParameter("max_depth_m", limit);
  startNode(scene.light_field);
  const ImageListener depth(*node_space_, "depth");
  const CloudListener points2(*node_space_, "points2");
  const Listener<stereo_msgs::DisparityImage> disparity(*node_space_, "disparity");
  ASSERT_TRUE(
      publishUntil(array, [&] { return depth.count() > 0 && points2.count() > 0 && disparity.count() > 0; }));
  const cv::Mat metres = pixelsOf(*depth.newest());
  int invalid = 0;
  for (int y = 0; y < metres.rows; ++y)
  {
    for (int x = 0; x < metres.cols; ++x)
    {
      const float z = metres.at<float>(y, x);
      EXPECT_FALSE(z > limit + 1e-4);
      invalid += std::isnan(z) ? 1 : 0;
    }
  }
  EXPECT_GT(invalid, 0);
  for (sensor_msgs::PointCloud2ConstIterator<float> z(*points2.newest(), "z"); z != z.end(); ++z)
  {
    ASSERT_FALSE(*z > limit + 1e-4);
  }
  const cv::Mat absolute = pixelsOf(disparity.newest()->image);
  EXPECT_GT(cv::countNonZero(absolute < disparity.newest()->min_disparity), 0) << "invalid there as well";
}

TEST_F(RobotTest, PausesAndAsksForSingleFrames)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("paused", true);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  EXPECT_EQ(array.topicsHeard(), 0U) << "it begins paused";
  trigger(*node_space_, "process_once");
  ASSERT_TRUE(publishUntil(array, [&] { return stats.count() > 0; }));
  EXPECT_TRUE(waitFor([&] { return array.topicsHeard() == 0; })) << "paused again";
  EXPECT_EQ(stats.count(), 1U);
  pause(*node_space_, false);
  EXPECT_TRUE(publishUntil(array, [&] { return stats.count() > 3; }));
  pause(*node_space_, true);
  EXPECT_TRUE(waitFor([&] { return array.topicsHeard() == 0; }));
}

TEST_F(RobotTest, SavesWhatEstimateWrites)
{
  const TemporaryFolder folder;
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  EXPECT_NE(trigger(*node_space_, "save", false).find("save_directory"), std::string::npos);
  node_.reset();
  setParameter("save_directory", folder.path().string());
  startNode(scene.light_field, {}, saveResult);
  {
    const StatsListener stats(*node_space_, "stats");
    ASSERT_TRUE(publishUntil(array, [&] { return stats.count() > 0; }));
  }
  trigger(*node_space_, "save");
  const auto saved = [&]
  {
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    {
      if (std::filesystem::exists(entry.path() / "report.json"))
      {
        return entry.path();
      }
    }
    return std::filesystem::path();
  };
  ASSERT_TRUE(waitFor([&] { return !saved().empty(); })) << "the last set, though none comes any more";
  for (const char* const file :
       {"disparity.pfm", "confidence.pfm", "depth.pfm", "cloud.ply", "dense_cloud.ply"})
  {
    EXPECT_TRUE(std::filesystem::exists(saved() / file)) << file;
  }
}

}  // namespace
}  // namespace light_field_depth::testing
