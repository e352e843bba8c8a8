#ifndef LIGHT_FIELD_DEPTH_ROS_DEPTH_NODE_H
#define LIGHT_FIELD_DEPTH_ROS_DEPTH_NODE_H

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <ros/node_handle.h>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/pipeline.h"

namespace light_field_depth
{
/// A result that is to be saved, and what is to be known of it.
struct ResultToSave
{
  std::string folder;                      ///< to be made if need be
  std::string source;                      ///< topic of the reference view's images
  std::size_t views_found = 0;             ///< how many views the array has
  GridPosition reference;                  ///< place of the reference view in the grid
  int threads = 0;                         ///< that work inside a stage
  PipelineOptions options;                 ///< that the result was made with
  std::optional<Calibration> calibration;  ///< of the reference view
  const PipelineResult& result;            ///< what is to be written
};

/// Writes a result to its folder. Called by a thread of the node's own. @throw InputError
using ResultSaver = std::function<void(const ResultToSave& result)>;

/// Depth from an array of image topics: the whole node, in a nodelet manager or alone.
///
/// The callbacks of the node handle's queue only move pointers; one thread of its own works on whole sets of
/// images, and another publishes their results while the next set is worked on. Bad input costs a frame and a
/// sentence in the log, never the process.
class DepthNode
{
public:
  /// @param saver for the service ~save, since this library knows no files; nullptr: nothing can be saved
  /// @throw InputError for parameters that cannot be used, before anything is advertised
  DepthNode(const ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle,
            ResultSaver saver = nullptr);

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
