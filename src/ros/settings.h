#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_SETTINGS_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_SETTINGS_H

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>
#include <boost/thread/recursive_mutex.hpp>

#include "light_field_depth/LightFieldDepthConfig.h"
#include "light_field_depth/core/pipeline.h"

namespace light_field_depth
{
/// What may change while the node runs.
struct NodeSettings
{
  PipelineOptions pipeline;
  bool dense_cloud = true;  ///< false: points_dense stays silent whoever listens
  /// Most clouds a second on points_dense; 0: one for every set. Others wait for a cloud less often.
  double dense_cloud_max_rate_hz = 0.0;
};

/// @throw InputError with a sentence for each field that cannot be used
NodeSettings settingsFrom(const LightFieldDepthConfig& config);

/// Which numbers the preset of multiview has changed: "The preset is now fast: multiview_label_step_px 0.25
/// (was 0.125), ...". Empty if the preset is the same.
std::string describePresetChange(const PipelineOptions& before, const PipelineOptions& after);

/// The settings as dynamic_reconfigure holds them: every frame takes one snapshot. What cannot be used is
/// refused, and the values in force are reported back. Thread safe.
class SettingsServer
{
public:
  using RefusalCallback = std::function<void(const std::string& sentence)>;

  /// @param on_refusal called with the reason when a change is refused
  SettingsServer(const ros::NodeHandle& private_node_handle, RefusalCallback on_refusal);

  std::shared_ptr<const NodeSettings> snapshot() const;

private:
  void reconfigure(LightFieldDepthConfig& config);

  RefusalCallback on_refusal_;
  mutable std::mutex mutex_;  ///< guards settings_
  std::shared_ptr<const NodeSettings> settings_;
  LightFieldDepthConfig config_;  ///< that settings_ was made of; used by the server's callback alone
  boost::recursive_mutex server_mutex_;
  dynamic_reconfigure::Server<LightFieldDepthConfig> server_;  ///< last: its callback uses the others
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_SETTINGS_H
