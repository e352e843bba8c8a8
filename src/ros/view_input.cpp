#include "ros/view_input.h"

#include <chrono>
#include <optional>
#include <utility>

#include <boost/function.hpp>

namespace light_field_depth
{
namespace
{
constexpr double NANOSECONDS_PER_SECOND = 1e9;

ViewSynchronizerOptions synchronizerOptions(const NodeParameters& parameters)
{
  ViewSynchronizerOptions options;
  options.view_count = parameters.array.views.size();
  options.queue_size = static_cast<std::size_t>(parameters.queue_size);
  options.tolerance_ns = static_cast<std::int64_t>(parameters.sync_tolerance_s * NANOSECONDS_PER_SECOND);
  return options;
}

}  // namespace

ViewInput::ViewInput(const ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle,
                     const NodeParameters& parameters, FrameCallback on_frame,
                     CalibratedCallback on_calibrated)
    : node_handle_(node_handle), private_node_handle_(private_node_handle), parameters_(parameters),
      on_frame_(std::move(on_frame)), on_calibrated_(std::move(on_calibrated)), image_transport_(node_handle),
      synchronizer_(synchronizerOptions(parameters)), infos_(parameters.array.views.size())
{
}

ViewInput::~ViewInput()
{
  unsubscribe();
}

void ViewInput::subscribe()
{
  if (image_subscribers_.empty())
  {
    for (std::size_t view = 0; view < parameters_.array.views.size(); ++view)
    {
      subscribeTo(view);
    }
  }
}

void ViewInput::subscribeTo(std::size_t view)
{
  const ViewTopics& topics = parameters_.array.views[view];
  const auto queue_size = static_cast<std::uint32_t>(parameters_.queue_size);
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  const boost::function<void(const sensor_msgs::ImageConstPtr&)> on_image =
      [this, view](const sensor_msgs::ImageConstPtr& image) { imageCallback(view, image); };
  image_subscribers_.push_back(image_transport_.subscribe(
      topics.image, queue_size, on_image, ros::VoidPtr(),
      image_transport::TransportHints(parameters_.image_transport, hints, private_node_handle_)));
  if (parameters_.use_camera_info)
  {
    const boost::function<void(const sensor_msgs::CameraInfoConstPtr&)> on_info =
        [this, view](const sensor_msgs::CameraInfoConstPtr& info) { cameraInfoCallback(view, info); };
    info_subscribers_.push_back(node_handle_.subscribe<sensor_msgs::CameraInfo>(
        topics.camera_info, 1, on_info, ros::VoidPtr(), hints));
  }
}

void ViewInput::unsubscribe()
{
  for (image_transport::Subscriber& subscriber : image_subscribers_)
  {
    subscriber.shutdown();
  }
  for (ros::Subscriber& subscriber : info_subscribers_)
  {
    subscriber.shutdown();
  }
  image_subscribers_.clear();
  info_subscribers_.clear();
  const std::lock_guard<std::mutex> lock(mutex_);
  synchronizer_.reset();
}

void ViewInput::forget()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  synchronizer_.reset();
  infos_.assign(infos_.size(), nullptr);
  info_count_ = 0;
}

std::vector<sensor_msgs::CameraInfoConstPtr> ViewInput::cameraInfos() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return infos_;
}

ViewSynchronizerStatistics ViewInput::statistics() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return synchronizer_.statistics();
}

void ViewInput::imageCallback(std::size_t view, const sensor_msgs::ImageConstPtr& image)
{
  std::optional<Synchronizer::Set> set;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    set = synchronizer_.add(view, static_cast<std::int64_t>(image->header.stamp.toNSec()), image);
  }
  if (set)
  {
    on_frame_({std::move(set->payloads), set->spread_ns, std::chrono::steady_clock::now()});
  }
}

void ViewInput::cameraInfoCallback(std::size_t view, const sensor_msgs::CameraInfoConstPtr& info)
{
  bool calibrated = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (infos_[view] == nullptr)
    {
      calibrated = ++info_count_ == infos_.size();
    }
    infos_[view] = info;
  }
  if (calibrated)
  {
    on_calibrated_();
  }
}

}  // namespace light_field_depth
