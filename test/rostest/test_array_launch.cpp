// The robots of launch/array.launch: clouds in the robot's frame, upright and the right way round.

#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl_conversions/pcl_conversions.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "array_fixture.h"

namespace light_field_depth::testing
{
namespace
{
using Cloud = pcl::PointCloud<pcl::PointXYZRGB>;

/// How many points there are of a kind, and the mean of where they are.
struct Part
{
  std::size_t count = 0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

template <class Condition>
Part partOf(const Cloud& cloud, const Condition& belongs)
{
  Part part;
  for (const pcl::PointXYZRGB& point : cloud)
  {
    if (std::isfinite(point.x) && belongs(point))
    {
      ++part.count;
      part.x += point.x;
      part.y += point.y;
      part.z += point.z;
    }
  }
  const double count = part.count > 0 ? static_cast<double>(part.count) : 1.0;
  return {part.count, part.x / count, part.y / count, part.z / count};
}

class ArrayLaunch : public ::testing::Test
{
protected:
  ArrayLaunch() { spinner_.start(); }

  ros::AsyncSpinner spinner_{2};
  ros::NodeHandle node_handle_;
};

TEST_F(ArrayLaunch, GivesACloudInTheRobotsFrame)
{
  tf2_ros::Buffer frames;
  const tf2_ros::TransformListener listener(frames);
  const Listener<sensor_msgs::PointCloud2> clouds(node_handle_, "/light_field_depth/points2");
  const Listener<sensor_msgs::CameraInfo> infos(node_handle_, "/light_field_depth/camera_info");
  ASSERT_TRUE(waitFor([&] { return clouds.count() > 0 && infos.count() > 0; }, std::chrono::seconds(60)));
  const sensor_msgs::PointCloud2ConstPtr message = clouds.newest();
  EXPECT_EQ(message->header.frame_id, "base_link");
  const std::string camera = infos.newest()->header.frame_id;
  EXPECT_NE(camera.find("_optical_frame"), std::string::npos) << camera;
  EXPECT_TRUE(frames.canTransform("base_link", camera, ros::Time(0), ros::Duration(10.0)))
      << "tf knows where the camera " << camera << " stands on the robot";

  Cloud cloud;
  pcl::fromROSMsg(*message, cloud);
  const Part all = partOf(cloud, [](const auto&) { return true; });
  EXPECT_GT(all.count, cloud.size() / 2);
  const Part below = partOf(cloud, [](const auto& point) { return point.z < -0.1F; });
  EXPECT_LT(below.count, all.count / 100) << "nothing is below the floor";
  // data/make_robots.py says where things stand.
  const Part floor = partOf(cloud, [](const auto& point) { return point.x < 1.3F; });
  EXPECT_GT(floor.count, all.count / 20);
  EXPECT_NEAR(floor.z, 0.0, 0.01) << "the floor is where the robot stands";
  const Part red =
      partOf(cloud, [](const auto& point) { return point.r > 2 * point.g && point.r > 2 * point.b; });
  EXPECT_GT(red.count, 1000U);
  EXPECT_NEAR(red.y, 0.7, 0.05) << "the red crate is on the left";
  EXPECT_GT(red.z, 0.1);
  EXPECT_NEAR(red.x, 1.85, 0.1);
  const Part green =
      partOf(cloud, [](const auto& point) { return point.g > 1.5F * point.r && point.g > 1.5F * point.b; });
  EXPECT_GT(green.count, 300U);
  EXPECT_NEAR(green.y, -0.4, 0.1) << "the green one is on the right";
  EXPECT_NEAR(green.x, 2.4, 0.1);
}

}  // namespace
}  // namespace light_field_depth::testing

int main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_array_launch");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
