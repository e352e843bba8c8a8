#include "ros/result_publisher.h"

#include <sensor_msgs/PointCloud2.h>
#include <stereo_msgs/DisparityImage.h>
#include <boost/make_shared.hpp>

#include "light_field_depth/ros/result_messages.h"

namespace light_field_depth
{
namespace
{
/// Results are newest-wins as the input is.
constexpr std::uint32_t QUEUE_SIZE = 1;

template <class Message>
ros::Publisher advertise(ros::NodeHandle node_handle, const std::string& topic,
                         const std::function<void()>& on_change)
{
  const ros::SubscriberStatusCallback callback = [on_change](const ros::SingleSubscriberPublisher&)
  { on_change(); };
  return node_handle.advertise<Message>(topic, QUEUE_SIZE, callback, callback);
}

image_transport::Publisher advertiseImage(image_transport::ImageTransport& transport,
                                          const std::string& topic, const std::function<void()>& on_change)
{
  const image_transport::SubscriberStatusCallback callback =
      [on_change](const image_transport::SingleSubscriberPublisher&) { on_change(); };
  return transport.advertise(topic, QUEUE_SIZE, callback, callback);
}

}  // namespace

ResultPublisher::ResultPublisher(const ros::NodeHandle& private_node_handle,
                                 const std::function<void()>& on_subscribers_changed)
    : image_transport_(private_node_handle), disparity_(advertise<stereo_msgs::DisparityImage>(
                                                 private_node_handle, "disparity", on_subscribers_changed)),
      disparity_color_(advertiseImage(image_transport_, "disparity_color", on_subscribers_changed)),
      depth_(advertiseImage(image_transport_, "depth", on_subscribers_changed)),
      depth_mm_(advertiseImage(image_transport_, "depth_mm", on_subscribers_changed)),
      confidence_(advertiseImage(image_transport_, "confidence", on_subscribers_changed)),
      confidence_mono8_(advertiseImage(image_transport_, "confidence_mono8", on_subscribers_changed)),
      points2_(advertise<sensor_msgs::PointCloud2>(private_node_handle, "points2", on_subscribers_changed)),
      points_dense_(
          advertise<sensor_msgs::PointCloud2>(private_node_handle, "points_dense", on_subscribers_changed)),
      camera_info_(
          advertise<sensor_msgs::CameraInfo>(private_node_handle, "camera_info", on_subscribers_changed)),
      left_image_(advertiseImage(image_transport_, "left/image_rect_color", on_subscribers_changed)),
      left_info_(advertise<sensor_msgs::CameraInfo>(private_node_handle, "left/camera_info",
                                                    on_subscribers_changed)),
      right_info_(advertise<sensor_msgs::CameraInfo>(private_node_handle, "right/camera_info",
                                                     on_subscribers_changed)),
      stats_(advertise<LightFieldDepthStats>(private_node_handle, "stats", on_subscribers_changed))
{
}

Subscribers ResultPublisher::subscribers() const
{
  Subscribers subscribers;
  subscribers.disparity = disparity_.getNumSubscribers() > 0;
  subscribers.disparity_color = disparity_color_.getNumSubscribers() > 0;
  subscribers.depth = depth_.getNumSubscribers() > 0;
  subscribers.depth_mm = depth_mm_.getNumSubscribers() > 0;
  subscribers.confidence_mono8 = confidence_mono8_.getNumSubscribers() > 0;
  subscribers.confidence = confidence_.getNumSubscribers() > 0;
  subscribers.points2 = points2_.getNumSubscribers() > 0;
  subscribers.points_dense = points_dense_.getNumSubscribers() > 0;
  subscribers.camera_info = camera_info_.getNumSubscribers() > 0;
  subscribers.stereo_infos = left_info_.getNumSubscribers() > 0 || right_info_.getNumSubscribers() > 0;
  subscribers.reference_image = left_image_.getNumSubscribers() > 0;
  subscribers.stats = stats_.getNumSubscribers() > 0;
  return subscribers;
}

void ResultPublisher::publish(const FrameProducts& products) const
{
  const std_msgs::Header& header = products.header;
  const Subscribers& subscribers = products.subscribers;
  const PipelineResult& result = products.result;
  if (subscribers.camera_info)
  {
    const auto info = boost::make_shared<sensor_msgs::CameraInfo>(products.info);
    info->header = header;
    camera_info_.publish(info);
  }
  if (subscribers.reference_image)
  {
    left_image_.publish(products.image);
  }
  if (subscribers.stereo_infos && products.calibration)
  {
    const StereoPair pair = stereoPair(header, *products.calibration, result.estimate.disparity.size());
    left_info_.publish(pair.left);
    right_info_.publish(pair.right);
  }
  if (subscribers.disparity)
  {
    DisparityEstimate shown = result.estimate;
    shown.disparity = products.limited_disparity.empty() ? shown.disparity : products.limited_disparity;
    disparity_.publish(
        disparityMessage(header, shown, products.calibration, products.min_confidence, products.keep_filled));
  }
  if (subscribers.disparity_color)
  {
    disparity_color_.publish(disparityColorMessage(header, result.estimate));
  }
  if (subscribers.depth && !result.depth.empty())
  {
    depth_.publish(floatImageMessage(header, result.depth));
  }
  if (subscribers.depth_mm && !result.depth.empty())
  {
    depth_mm_.publish(millimetreImageMessage(header, result.depth));
  }
  if (subscribers.confidence_mono8)
  {
    confidence_mono8_.publish(confidenceMono8Message(header, result.estimate.confidence));
  }
  if (subscribers.confidence)
  {
    confidence_.publish(floatImageMessage(header, result.estimate.confidence));
  }
  if (products.points2 != nullptr)
  {
    points2_.publish(products.points2);
  }
  if (products.points_dense != nullptr)
  {
    publishDenseCloud(products.points_dense);
  }
}

void ResultPublisher::publishDenseCloud(const sensor_msgs::PointCloud2Ptr& cloud) const
{
  points_dense_.publish(cloud);
}

void ResultPublisher::publish(const LightFieldDepthStats& stats) const
{
  stats_.publish(stats);
}

void ResultPublisher::shutdown()
{
  disparity_.shutdown();
  disparity_color_.shutdown();
  depth_.shutdown();
  depth_mm_.shutdown();
  confidence_.shutdown();
  confidence_mono8_.shutdown();
  points2_.shutdown();
  points_dense_.shutdown();
  camera_info_.shutdown();
  left_image_.shutdown();
  left_info_.shutdown();
  right_info_.shutdown();
  stats_.shutdown();
}

}  // namespace light_field_depth
