#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_DEPTH_NODE_IMPLEMENTATION_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_DEPTH_NODE_IMPLEMENTATION_H

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/steady_timer.h>
#include <std_srvs/Empty.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/ros/depth_node.h"
#include "ros/background_runner.h"
#include "ros/cloud_transformer.h"
#include "ros/dense_cloud_maker.h"
#include "ros/frame_queue.h"
#include "ros/input_health.h"
#include "ros/light_field_assembler.h"
#include "ros/master_watch.h"
#include "ros/message_pool.h"
#include "ros/node_diagnostics.h"
#include "ros/node_parameters.h"
#include "ros/rate_limit.h"
#include "ros/result_publisher.h"
#include "ros/result_watch.h"
#include "ros/settings.h"
#include "ros/view_input.h"

namespace light_field_depth
{
/// What the stats say of one frame besides its results.
struct FrameReport
{
  using Time = std::chrono::steady_clock::time_point;

  std::vector<bool> used_by_view;
  std::int64_t stamp_spread_ns = 0;
  std::string method;
  // When the steps were done.
  Time arrived;
  Time taken;
  Time assembled;
  Time computed;
  Time published;
};

/// What is to be made of a frame.
struct FrameDemand
{
  Subscribers subscribers;
  bool everything = false;   ///< the result is going to be saved
  bool dense_cloud = false;  ///< one is due on points_dense
};

/// The parts of a DepthNode and the threads that run them: the worker, the publication, and the maker of
/// dense clouds with threads of its own.
class DepthNode::Implementation
{
public:
  Implementation(const ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle,
                 ResultSaver saver);
  ~Implementation();
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

private:
  void updateSubscriptions();
  void watch(const ros::SteadyTimerEvent& event);
  void watchInput(bool listening, const ViewSynchronizerStatistics& heard);
  void reportHealth(bool listening, const ViewSynchronizerStatistics& heard);
  void dropUncalibratedViews(FrameSet& set, const std::vector<sensor_msgs::CameraInfoConstPtr>& infos);

  void warnOfMissingMasks(const FrameSet& set, const std::vector<sensor_msgs::ImageConstPtr>& masks);

  void advertiseServices(ros::NodeHandle node_handle);
  bool reset(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool processOnce(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool save(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void saveSafely(const FrameProducts& products, const NodeSettings& settings);

  void workerLoop();
  void processSafely(FrameSet set);
  void process(FrameSet set, const Subscribers& subscribers, bool asked_for);
  FrameProducts compute(const LightField& light_field, const NodeSettings& settings,
                        const std_msgs::Header& header, const FrameDemand& demand);
  bool makeDenseCloud(FinishedFrame frame, bool wait);
  PointAllocator leftOutWhenTooLarge(PointAllocator allocator);
  void broadcastViews(const LightField& light_field, const FrameSet& set, const std_msgs::Header& header);
  sensor_msgs::PointCloud2Ptr transformed(const sensor_msgs::PointCloud2Ptr& cloud);
  void publishDenseCloud(const FinishedFrame& frame, const sensor_msgs::PointCloud2Ptr& cloud);
  void publishSafely(FrameProducts& products, FrameReport report);
  LightFieldDepthStats statsOf(const FrameProducts& products, const FrameReport& report) const;

  const NodeParameters parameters_;
  const ResultSaver saver_;
  NodeDiagnostics diagnostics_;
  SettingsServer settings_;
  FrameQueue queue_;
  ViewInput input_;
  Pipeline pipeline_;              ///< used by the worker alone, but for cancel()
  LightFieldAssembler assembler_;  ///< used by the worker alone; works on the pipeline's threads
  ResultWatch result_watch_;       ///< used by the worker alone
  MessagePool<sensor_msgs::PointCloud2> organized_clouds_;
  RateLimit dense_cloud_rate_;  ///< used by the worker alone

  std::mutex subscription_mutex_;  ///< guards results_ while it is made, and who is subscribed to what
  bool subscribed_ = false;
  bool shutting_down_ = false;
  std::unique_ptr<ResultPublisher> results_;
  std::unique_ptr<CloudTransformer> cloud_transformer_;  ///< null without target_frame
  std::vector<geometry_msgs::TransformStamped>
      view_frames_;  ///< that were sent last; used by the worker alone
  std::unique_ptr<tf2_ros::StaticTransformBroadcaster> broadcaster_;
  std::atomic<bool> forget_frames_{false};  ///< before the next one
  std::atomic<bool> paused_{false};
  std::atomic<int> once_{0};           ///< sets that are worked on whoever listens, and even while paused
  std::atomic<bool> save_{false};      ///< the next result
  std::mutex last_set_mutex_;          ///< guards last_set_
  FrameSet last_set_;                  ///< that was worked on
  BackgroundRunner publication_;       ///< after what its jobs use
  DenseCloudMaker dense_cloud_maker_;  ///< likewise
  MasterWatch master_watch_;

  std::vector<ros::ServiceServer> services_;
  ros::SteadyTimer watch_timer_;
  std::chrono::steady_clock::time_point silent_since_;  ///< used by watch() alone
  ViewSynchronizerStatistics heard_before_;             ///< at silent_since_
  InputHealth health_;                                  ///< used by watch() alone
  std::thread worker_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_DEPTH_NODE_IMPLEMENTATION_H
