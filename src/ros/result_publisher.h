#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_RESULT_PUBLISHER_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_RESULT_PUBLISHER_H

#include <functional>
#include <optional>

#include <image_transport/image_transport.h>
#include <image_transport/publisher.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include "light_field_depth/LightFieldDepthStats.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/pipeline.h"

namespace light_field_depth
{
/// Which results somebody listens to.
struct Subscribers
{
  bool disparity = false;
  bool disparity_color = false;
  bool depth = false;
  bool depth_mm = false;
  bool confidence = false;
  bool confidence_mono8 = false;
  bool points2 = false;
  bool points_dense = false;
  bool camera_info = false;
  bool stereo_infos = false;
  bool reference_image = false;
  bool stats = false;

  bool any() const
  {
    return disparity || disparity_color || depth || depth_mm || confidence || confidence_mono8 || points2 ||
           points_dense || camera_info || stereo_infos || reference_image || stats;
  }
};

/// What a frame's publication takes, and all of it: nothing here belongs to the frames that follow.
struct FrameProducts
{
  std_msgs::Header header;
  Subscribers subscribers;
  std::optional<Calibration> calibration;
  float min_confidence = 0.0F;
  bool keep_filled = false;
  PipelineResult result;
  cv::Mat limited_disparity;  ///< that of the result with NaN beyond the limits of depth; may be empty
  sensor_msgs::PointCloud2Ptr points2;       ///< null when nobody wants it, or it cannot be had
  sensor_msgs::PointCloud2Ptr points_dense;  ///< likewise; null when it comes later
  sensor_msgs::CameraInfo info;              ///< of the reference view's image
  sensor_msgs::ImageConstPtr image;          ///< of the reference view
};

/// The topics of the results. Thread safe, except shutdown().
class ResultPublisher
{
public:
  /// @param on_subscribers_changed called after somebody began or ceased to listen, from the threads of the
  /// node
  ///   handle's callback queue, possibly before the constructor has returned
  ResultPublisher(const ros::NodeHandle& private_node_handle,
                  const std::function<void()>& on_subscribers_changed);

  Subscribers subscribers() const;

  /// Publishes what the subscribers of this frame listen to, all but the stats. Without a calibration there
  /// is no depth, no cloud and no stereo pair.
  void publish(const FrameProducts& products) const;

  void publish(const LightFieldDepthStats& stats) const;
  void publishDenseCloud(const sensor_msgs::PointCloud2Ptr& cloud) const;

  void shutdown();

private:
  image_transport::ImageTransport image_transport_;
  ros::Publisher disparity_;
  image_transport::Publisher disparity_color_;
  image_transport::Publisher depth_;
  image_transport::Publisher depth_mm_;
  image_transport::Publisher confidence_;
  image_transport::Publisher confidence_mono8_;
  ros::Publisher points2_;
  ros::Publisher points_dense_;
  ros::Publisher camera_info_;
  image_transport::Publisher left_image_;
  ros::Publisher left_info_;
  ros::Publisher right_info_;
  ros::Publisher stats_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_RESULT_PUBLISHER_H
