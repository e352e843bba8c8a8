#ifndef LIGHT_FIELD_DEPTH_ROS_DEPTH_NODE_H
#define LIGHT_FIELD_DEPTH_ROS_DEPTH_NODE_H

#include <memory>

#include <ros/node_handle.h>

namespace light_field_depth
{
/// Depth from an array of image topics: the whole node, in a nodelet manager or alone.
///
/// The callbacks of the node handle's queue only move pointers; one thread of its own works on whole sets of
/// images, and another publishes their results while the next set is worked on. Bad input costs a frame and a
/// sentence in the log, never the process.
class DepthNode
{
public:
  /// @throw InputError for parameters that cannot be used, before anything is advertised
  DepthNode(const ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle);

  /// Cancels the frame in hand; returns soon, with nothing of this node running any more.
  ~DepthNode();
  DepthNode(const DepthNode&) = delete;
  DepthNode& operator=(const DepthNode&) = delete;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_ROS_DEPTH_NODE_H
