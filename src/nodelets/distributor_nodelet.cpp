#include <exception>
#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "light_field_depth/ros/distributor_node.h"

namespace light_field_depth
{
/// DistributorNode in a nodelet manager.
class DistributorNodelet : public nodelet::Nodelet
{
private:
  /// Throws nothing: an exception would take the manager and its other nodelets along.
  void onInit() override
  {
    try
    {
      node_ = std::make_unique<DistributorNode>(getNodeHandle(), getPrivateNodeHandle());
    }
    catch (const std::exception& error)
    {
      NODELET_FATAL_STREAM(error.what() << " This nodelet stays loaded, but does nothing.");
    }
  }

  std::unique_ptr<DistributorNode> node_;
};

}  // namespace light_field_depth

PLUGINLIB_EXPORT_CLASS(light_field_depth::DistributorNodelet, nodelet::Nodelet)
