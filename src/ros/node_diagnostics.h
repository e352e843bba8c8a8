#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_NODE_DIAGNOSTICS_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_NODE_DIAGNOSTICS_H

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include "ros/input_health.h"
#include "ros/log_throttle.h"
#include "ros/recent_frames.h"
#include "ros/view_synchronizer.h"

namespace light_field_depth
{
/// What the diagnostics say of the input, besides warnings.
struct InputState
{
  ViewSynchronizerStatistics input;
  std::uint64_t frames_dropped = 0;
  bool listening = false;
  HealthReport health;
  std::string missing_topic;  ///< of the view that was missing most often; empty if none was
  std::uint64_t missing = 0;  ///< how often
};

/// What became of the dense clouds since the node started.
struct DenseCloudCounts
{
  std::uint64_t published = 0;
  std::uint64_t skipped = 0;     ///< frames that were due for one while another was being made
  double last_latency_ms = 0.0;  ///< from the arrival of the set's last image; 0: none yet
};

/// What the node tells its operator: sentences in the log, not too often, and the diagnostics. Thread safe,
/// except update().
class NodeDiagnostics
{
public:
  NodeDiagnostics(const ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle);

  /// A frame has been published, just now. @param latency_ms from the arrival of its last image
  void framePublished(double latency_ms);
  /// A dense cloud has been published, just now. @param latency_ms as above
  void denseCloudPublished(double latency_ms);
  /// There is none of a frame that was due for one, since another is being made.
  void denseCloudSkipped();
  /// A frame could not be worked on. The sentence goes into the log unless it has just been there.
  void frameFailed(const std::string& sentence);
  /// Something that should be looked at, logged likewise.
  void warn(const std::string& sentence);
  /// Something that keeps all results away, logged likewise.
  void error(const std::string& sentence);

  /// What gives to doubt in the results of late; empty if nothing does. New sentences are logged.
  void setDoubts(const std::vector<std::string>& sentences);

  std::uint64_t framesPublished() const;
  std::uint64_t framesFailed() const;
  RecentFrames::Summary recentFrames() const;
  DenseCloudCounts denseClouds() const;

  /// Publishes the diagnostics when they are due, by a clock that no simulation turns back.
  void update(const InputState& state);

private:
  void reportInput(diagnostic_updater::DiagnosticStatusWrapper& status);
  void give(const std::string& sentence, Health health);
  void reportFrames(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportResult(diagnostic_updater::DiagnosticStatusWrapper& status);
  bool isNews(const std::string& sentence)
  {
    return logged_.isNews(sentence, std::chrono::steady_clock::now());
  }

  mutable std::mutex mutex_;  ///< guards what follows
  std::uint64_t frames_published_ = 0;
  std::uint64_t frames_failed_ = 0;
  RecentFrames recent_;
  DenseCloudCounts dense_clouds_;
  std::string last_failure_;  ///< empty after a frame that went well
  std::string last_warning_;
  Health warned_health_ = Health::Ok;
  std::chrono::steady_clock::time_point warned_at_;
  std::vector<std::string> doubts_;
  LogThrottle logged_;

  // Used by update() alone.
  InputState state_;
  std::chrono::steady_clock::time_point updated_at_;
  diagnostic_updater::Updater updater_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_NODE_DIAGNOSTICS_H
