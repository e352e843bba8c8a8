#ifndef LIGHT_FIELD_DEPTH_ROS_DISTRIBUTOR_NODE_H
#define LIGHT_FIELD_DEPTH_ROS_DISTRIBUTOR_NODE_H

#include <memory>

#include <ros/node_handle.h>

namespace light_field_depth
{
/// Spreads the sets of an array over depth nodes, on this machine or on others, and publishes their results
/// in the order of the stamps.
///
/// Each whole set goes to one worker that is idle, by its own image topics: WORKER/IMAGE_TOPIC of each
/// view. Results come back from WORKER/light_field_depth/ and are published under this node's own name;
/// only what somebody listens to is asked for. A worker that dies, or says nothing for `patience`, costs its
/// set; it is used again when it is back. A set that comes while all are busy replaces the one that waits.
class DistributorNode
{
public:
  /// Reads the parameters array, workers (a list of namespaces), sync_tolerance, queue_size, patience,
  /// keep_all and image_transport.
  /// @throw InputError for parameters that cannot be used, before anything is advertised
  DistributorNode(const ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle);
  ~DistributorNode();
  DistributorNode(const DistributorNode&) = delete;
  DistributorNode& operator=(const DistributorNode&) = delete;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_ROS_DISTRIBUTOR_NODE_H
