#include <exception>
#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "light_field_depth/nodelets/result_saver.h"
#include "light_field_depth/ros/depth_node.h"

namespace light_field_depth
{
/// DepthNode in a nodelet manager. One callback queue of the manager, single threaded, serves it.
class DepthNodelet : public nodelet::Nodelet
{
private:
  /// Throws nothing: an exception would take the manager and its other nodelets along.
  void onInit() override
  {
    try
    {
      node_ = std::make_unique<DepthNode>(getNodeHandle(), getPrivateNodeHandle(), saveResult);
    }
    catch (const std::exception& error)
    {
      NODELET_FATAL_STREAM(error.what() << " This nodelet stays loaded, but does nothing.");
    }
  }

  std::unique_ptr<DepthNode> node_;
};

}  // namespace light_field_depth

PLUGINLIB_EXPORT_CLASS(light_field_depth::DepthNodelet, nodelet::Nodelet)
