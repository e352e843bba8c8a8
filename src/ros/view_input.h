#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_INPUT_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_INPUT_H

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include <image_transport/image_transport.h>
#include <image_transport/subscriber.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "ros/frame_queue.h"
#include "ros/node_parameters.h"
#include "ros/view_image.h"
#include "ros/view_quorum.h"
#include "ros/view_synchronizer.h"

namespace light_field_depth
{
/// The topics of all views: brings images of one moment together and keeps the newest CameraInfo of each
/// view. The callbacks only move pointers. subscribe(), unsubscribe() are for one thread at a time; the rest
/// is thread safe.
class ViewInput
{
public:
  using FrameCallback = std::function<void(FrameSet)>;
  using CalibratedCallback = std::function<void()>;
  using RefusedCallback = std::function<void(const std::string& sentence)>;

  /// @param on_frame      called with every whole set
  /// @param on_calibrated called when every view that is not given up has had a CameraInfo
  /// @param on_refused    called with a sentence for every message that is larger than the limit, and is not
  /// used All are called from the threads of the node handle's callback queue.
  ViewInput(const ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle,
            const NodeParameters& parameters, FrameCallback on_frame, CalibratedCallback on_calibrated,
            RefusedCallback on_refused);
  ~ViewInput();

  void subscribe();
  /// Returns when no callback is running any more. What was incomplete is forgotten, CameraInfos are kept.
  void unsubscribe();

  /// Drops incomplete sets and the CameraInfos of topics.
  void forget();

  /// Gives up, until their next message, the views from which no image has come for so long, if the others
  /// can stand for all. @return all views that are given up now
  std::vector<std::size_t> giveUpSilentViews(double seconds);

  /// Whether every view that is not given up has a CameraInfo, from its topic or from its file.
  bool hasCameraInfos() const;

  const ViewQuorum& quorum() const { return quorum_; }
  std::vector<sensor_msgs::CameraInfoConstPtr> cameraInfos() const;  ///< null where none has come yet
  std::vector<sensor_msgs::ImageConstPtr> masks() const;  ///< null where there is none, or none has come yet
  ViewSynchronizerStatistics statistics() const;

private:
  using Synchronizer = ViewSynchronizer<ViewImage>;

  void subscribeTo(std::size_t view);
  void deliver(std::vector<Synchronizer::Set> sets);
  bool isCalibrated() const;
  /// Calls on_refused for what is too large. @return whether it is not
  bool isAdmitted(std::size_t view, const ViewImage& image) const;
  void imageCallback(std::size_t view, const ViewImage& image);
  void cameraInfoCallback(std::size_t view, const sensor_msgs::CameraInfoConstPtr& info);

  ros::NodeHandle node_handle_;
  ros::NodeHandle private_node_handle_;
  NodeParameters parameters_;
  ViewQuorum quorum_;
  FrameCallback on_frame_;
  CalibratedCallback on_calibrated_;
  RefusedCallback on_refused_;
  image_transport::ImageTransport image_transport_;
  std::vector<image_transport::Subscriber> image_subscribers_;
  std::vector<ros::Subscriber> compressed_subscribers_;
  std::vector<ros::Subscriber> info_subscribers_;
  std::vector<ros::Subscriber> mask_subscribers_;

  mutable std::mutex mutex_;  ///< guards what follows
  Synchronizer synchronizer_;
  std::vector<sensor_msgs::CameraInfoConstPtr> infos_;
  std::vector<sensor_msgs::ImageConstPtr> masks_;
  std::vector<std::chrono::steady_clock::time_point> heard_;  ///< when each view's last image came
  std::vector<bool> given_up_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_INPUT_H
