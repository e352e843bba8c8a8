#include <csignal>
#include <cstdlib>
#include <exception>

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include "light_field_depth/nodelets/result_saver.h"
#include "light_field_depth/ros/depth_node.h"

namespace
{
/// As roscpp does for SIGINT: the node ends in order and unregisters.
void requestShutdown(int /*signal*/)
{
  ros::requestShutdown();
}

}  // namespace

int main(int argc, char** argv)
{
  ros::init(argc, argv, "light_field_depth");
  // Otherwise the last NodeHandle, which an exception destroys before it is caught, takes the console along.
  ros::start();
  std::signal(SIGTERM, requestShutdown);
  std::signal(SIGHUP, requestShutdown);
  try
  {
    const light_field_depth::DepthNode node(ros::NodeHandle(), ros::NodeHandle("~"),
                                            light_field_depth::saveResult);
    ros::spin();
  }
  catch (const std::exception& error)
  {
    ROS_FATAL_STREAM(error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
