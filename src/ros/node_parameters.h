#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_NODE_PARAMETERS_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_NODE_PARAMETERS_H

#include <cstddef>
#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>

#include "light_field_depth/core/input_limits.h"
#include "light_field_depth/ros/calibration_from_camera_info.h"
#include "light_field_depth/ros/view_array.h"
#include "ros/input_health.h"

namespace light_field_depth
{
/// JPEG and PNG on the topic below the image's, which this package decodes itself.
const std::string COMPRESSED_TRANSPORT = "compressed";

/// What is read once, when the node starts. Each field is a private parameter of the same name, without the
/// unit. What may change later is in config/LightFieldDepth.cfg.
struct NodeParameters
{
  /// `array`: the views and their topics.
  ViewArray array = defaultViewArray();

  /// CameraInfos of the views whose `array` names a file; null for the others.
  std::vector<sensor_msgs::CameraInfoConstPtr> camera_infos;

  /// `use_camera_info`: false takes the calibration from the parameters below alone.
  bool use_camera_info = true;

  /// `baseline_x`, `baseline_y`, `focal_length`, `principal_point_x`, `principal_point_y`,
  /// `disparity_offset`.
  CalibrationParameters calibration;

  /// `sync_tolerance`, in seconds: largest difference between the stamps of a set; 0: they are equal.
  double sync_tolerance_s = 0.0;

  /// `queue_size`: incomplete sets that are kept, and messages of a topic. Raise it when views of one stamp
  /// arrive many frames apart.
  int queue_size = 5;

  /// `keep_all`: work on every set, up to keep_all_limit of them waiting, instead of on the newest. For bags.
  bool keep_all = false;
  int keep_all_limit = 100;

  /// `lazy`: subscribe to the views only while somebody listens to a result.
  bool lazy = true;

  /// `threads` that work on a frame; 0 takes one per processor.
  int threads = 0;

  /// `max_views`, `max_megapixels` of an image as it comes, `max_message_size` in MB of a message with one.
  InputLimits limits;

  /// `max_memory`, in MB: a set that may need more is refused; 0: what the machine has.
  double max_memory_mb = 0.0;

  /// `frame_id` of the results; that of the reference image when empty.
  std::string frame_id;

  /// `image_transport` of the views. COMPRESSED_TRANSPORT needs no plugin.
  std::string image_transport = "raw";

  /// `check_order`: whether the places of the views are held against the images of the first frames. Only
  /// warns.
  bool check_order = true;

  /// `rectify`: the images are raw; each view is rectified by K, D, R and P of its CameraInfo.
  bool rectify = false;

  /// `mask_black`: what is black up to the border of an image shows nothing of the scene.
  bool mask_black = false;

  /// `decimation`: views are reduced to one pixel for so many by so many.
  int decimation = 1;

  /// `target_frame`: tf brings the clouds into it; empty: they stay in the frame of the reference view.
  std::string target_frame;

  /// `publish_tf`: static transforms from the frame of the reference view to the other views.
  bool publish_tf = false;

  /// `paused`: begin paused; the service ~pause changes it.
  bool paused = false;

  /// `save_directory`: the service ~save writes to a folder below it.
  std::string save_directory;

  /// `patience`, in seconds: how long without a whole set until a warning says what is missing.
  double patience_s = 5.0;

  /// `min_views`: a set counts as whole without the views that have been silent for `patience`, if so many
  /// are left; 0: three quarters. The reference view is always needed, and one on each side of it.
  int min_views = 0;

  /// `allow_incomplete`: also use sets that lack single images, once the view in question has gone on.
  bool allow_incomplete = false;

  /// `warn_incomplete`, `error_incomplete`, `warn_replaced`, `error_replaced`, `warn_latency`,
  /// `error_latency`: for the diagnostics.
  HealthThresholds health;

  /// Sentences about parameters that nobody reads or whose values were changed.
  std::vector<std::string> warnings;
};

/// How many whole sets may wait for whoever works on them.
std::size_t queueCapacity(const NodeParameters& parameters);

/// Only `array`, `sync_tolerance`, `queue_size`, `keep_all`, `keep_all_limit` and `patience`, for nodes that
/// put sets together and do no more.
/// @param defaults of what is not given
/// @throw InputError that names the parameter, its value and the remedy
NodeParameters readSetParameters(const ros::NodeHandle& private_node_handle, NodeParameters defaults);

/// @throw InputError that names the parameter, its value and the remedy
NodeParameters readNodeParameters(const ros::NodeHandle& private_node_handle);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_NODE_PARAMETERS_H
