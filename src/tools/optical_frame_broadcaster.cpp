#include <cmath>
#include <string>

#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <tf2/LinearMath/Quaternion.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "tools/tool_main.h"

namespace light_field_depth
{
namespace
{
/// From a frame with x forward and z up to an optical frame with z forward and y down (REP 103).
geometry_msgs::TransformStamped opticalTransform(const std::string& parent, const std::string& child)
{
  tf2::Quaternion rotation;
  rotation.setRPY(-M_PI_2, 0.0, -M_PI_2);
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time::now();
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.rotation.x = rotation.x();
  transform.transform.rotation.y = rotation.y();
  transform.transform.rotation.z = rotation.z();
  transform.transform.rotation.w = rotation.w();
  return transform;
}

}  // namespace
}  // namespace light_field_depth

int main(int argc, char** argv)
{
  using namespace light_field_depth;
  ros::init(argc, argv, "optical_frame_broadcaster");
  CLI::App app(
      "Publishes the rotation from a frame with z up to the optical frame of the images, so that RViz "
      "shows clouds upright.",
      "optical_frame_broadcaster");
  std::string parent;
  std::string child;
  app.add_option("--parent", parent, "The frame with x forward, z up")->required();
  app.add_option("--child", child, "The frame of the images")->required();
  return runTool(app, argc, argv,
                 [&]
                 {
                   const ros::NodeHandle keeps_ros_running;
                   tf2_ros::StaticTransformBroadcaster broadcaster;
                   broadcaster.sendTransform(opticalTransform(parent, child));
                   ros::spin();
                 });
}
