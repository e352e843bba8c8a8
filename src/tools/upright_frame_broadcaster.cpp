#include <cmath>
#include <string>

#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <tf2/LinearMath/Quaternion.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <boost/function.hpp>

#include "tools/tool_main.h"

namespace light_field_depth
{
namespace
{
/// From an optical frame (z forward, y down) to a frame at the same place with x forward and z up (REP 103).
/// The new frame is the child, so that the camera keeps the parent that it has, if it has one.
geometry_msgs::TransformStamped uprightTransform(const std::string& optical, const std::string& upright)
{
  tf2::Quaternion upright_to_optical;
  upright_to_optical.setRPY(-M_PI_2, 0.0, -M_PI_2);
  const tf2::Quaternion rotation = upright_to_optical.inverse();
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time::now();
  transform.header.frame_id = optical;
  transform.child_frame_id = upright;
  transform.transform.rotation.x = rotation.x();
  transform.transform.rotation.y = rotation.y();
  transform.transform.rotation.z = rotation.z();
  transform.transform.rotation.w = rotation.w();
  return transform;
}

void broadcast(const std::string& upright)
{
  ros::NodeHandle node_handle;
  tf2_ros::StaticTransformBroadcaster broadcaster;
  ros::Subscriber subscriber;
  const boost::function<void(const sensor_msgs::CameraInfoConstPtr&)> callback =
      [&](const sensor_msgs::CameraInfoConstPtr& info)
  {
    broadcaster.sendTransform(uprightTransform(info->header.frame_id, upright));
    subscriber.shutdown();  // nobody is to work for this listener any more
  };
  subscriber = node_handle.subscribe<sensor_msgs::CameraInfo>("camera_info", 1, callback);
  ros::spin();
}

}  // namespace
}  // namespace light_field_depth

int main(int argc, char** argv)
{
  using namespace light_field_depth;
  ros::init(argc, argv, "upright_frame_broadcaster");
  CLI::App app(
      "Takes the optical frame of the first message on camera_info and publishes a frame at the same place "
      "with "
      "x forward and z up, so that RViz shows clouds upright whether tf knows the camera or not.",
      "upright_frame_broadcaster");
  std::string frame;
  app.add_option("--frame", frame, "The name of the upright frame")->required();
  return runTool(app, argc, argv, [&] { broadcast(frame); });
}
