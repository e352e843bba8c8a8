// Several files of tests share this program, and so one ROS master.

#include <gtest/gtest.h>
#include <ros/ros.h>

int main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_camera_array");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
