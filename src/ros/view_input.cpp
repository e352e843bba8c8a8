#include "ros/view_input.h"

#include <chrono>
#include <optional>
#include <utility>

#include <boost/function.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/input_limits.h"

namespace light_field_depth
{
namespace
{
constexpr double NANOSECONDS_PER_SECOND = 1e9;

ViewSynchronizerOptions synchronizerOptions(const NodeParameters& parameters, const ViewQuorum& quorum)
{
  ViewSynchronizerOptions options;
  options.view_count = parameters.array.views.size();
  options.queue_size = static_cast<std::size_t>(parameters.queue_size);
  options.tolerance_ns = static_cast<std::int64_t>(parameters.sync_tolerance_s * NANOSECONDS_PER_SECOND);
  options.enough = [quorum](const std::vector<bool>& present) { return quorum.isEnough(present); };
  options.allow_incomplete = parameters.allow_incomplete;
  return options;
}

}  // namespace

ViewInput::ViewInput(const ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle,
                     const NodeParameters& parameters, FrameCallback on_frame,
                     CalibratedCallback on_calibrated, RefusedCallback on_refused)
    : node_handle_(node_handle), private_node_handle_(private_node_handle), parameters_(parameters),
      quorum_(parameters.array, static_cast<std::size_t>(parameters.min_views)),
      on_frame_(std::move(on_frame)), on_calibrated_(std::move(on_calibrated)),
      on_refused_(std::move(on_refused)), image_transport_(node_handle),
      synchronizer_(synchronizerOptions(parameters, quorum_)), infos_(parameters.camera_infos),
      masks_(parameters.array.views.size()), given_up_(parameters.array.views.size())
{
  infos_.resize(parameters.array.views.size());
  parameters_.camera_infos = infos_;
}

ViewInput::~ViewInput()
{
  unsubscribe();
}

void ViewInput::subscribe()
{
  if (image_subscribers_.empty() && compressed_subscribers_.empty())
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      heard_.assign(parameters_.array.views.size(), std::chrono::steady_clock::now());
    }
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
  if (parameters_.image_transport == COMPRESSED_TRANSPORT)
  {
    // Not by the plugin, which would decode in the callback, one image after the other.
    const boost::function<void(const sensor_msgs::CompressedImageConstPtr&)> on_image =
        [this, view](const sensor_msgs::CompressedImageConstPtr& image) { imageCallback(view, image); };
    compressed_subscribers_.push_back(node_handle_.subscribe<sensor_msgs::CompressedImage>(
        node_handle_.resolveName(topics.image) + "/" + COMPRESSED_TRANSPORT, queue_size, on_image,
        ros::VoidPtr(), hints));
  }
  else
  {
    const boost::function<void(const sensor_msgs::ImageConstPtr&)> on_image =
        [this, view](const sensor_msgs::ImageConstPtr& image) { imageCallback(view, image); };
    image_subscribers_.push_back(image_transport_.subscribe(
        topics.image, queue_size, on_image, ros::VoidPtr(),
        image_transport::TransportHints(parameters_.image_transport, hints, private_node_handle_)));
  }
  if (parameters_.use_camera_info && parameters_.camera_infos[view] == nullptr)
  {
    const boost::function<void(const sensor_msgs::CameraInfoConstPtr&)> on_info =
        [this, view](const sensor_msgs::CameraInfoConstPtr& info) { cameraInfoCallback(view, info); };
    info_subscribers_.push_back(node_handle_.subscribe<sensor_msgs::CameraInfo>(
        topics.camera_info, 1, on_info, ros::VoidPtr(), hints));
  }
  if (!topics.mask.empty())
  {
    const boost::function<void(const sensor_msgs::ImageConstPtr&)> on_mask =
        [this, view](const sensor_msgs::ImageConstPtr& mask)
    {
      if (isAdmitted(view, mask))
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        masks_[view] = mask;
      }
    };
    mask_subscribers_.push_back(
        node_handle_.subscribe<sensor_msgs::Image>(topics.mask, 1, on_mask, ros::VoidPtr(), hints));
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
  for (ros::Subscriber& subscriber : compressed_subscribers_)
  {
    subscriber.shutdown();
  }
  for (ros::Subscriber& subscriber : mask_subscribers_)
  {
    subscriber.shutdown();
  }
  image_subscribers_.clear();
  compressed_subscribers_.clear();
  info_subscribers_.clear();
  mask_subscribers_.clear();
  const std::lock_guard<std::mutex> lock(mutex_);
  synchronizer_.reset();
  given_up_.assign(given_up_.size(), false);
}

void ViewInput::forget()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  synchronizer_.reset();
  infos_ = parameters_.camera_infos;
}

std::vector<std::size_t> ViewInput::giveUpSilentViews(double seconds)
{
  std::vector<std::size_t> silent;
  std::vector<Synchronizer::Set> sets;
  bool calibrated = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    std::vector<bool> heard(heard_.size());
    for (std::size_t view = 0; view < heard_.size(); ++view)
    {
      heard[view] = std::chrono::duration<double>(now - heard_[view]).count() < seconds;
    }
    if (heard_.empty() || !quorum_.isEnough(heard))
    {
      return silent;
    }
    const bool calibrated_before = isCalibrated();
    for (std::size_t view = 0; view < heard.size(); ++view)
    {
      if (!heard[view])
      {
        silent.push_back(view);
        given_up_[view] = true;
        synchronizer_.setSilent(view);
      }
    }
    calibrated = !calibrated_before && isCalibrated();
    while (std::optional<Synchronizer::Set> set = synchronizer_.next())
    {
      sets.push_back(std::move(*set));
    }
  }
  if (calibrated)
  {
    on_calibrated_();
  }
  deliver(std::move(sets));
  return silent;
}

bool ViewInput::isCalibrated() const
{
  for (std::size_t view = 0; view < infos_.size(); ++view)
  {
    if (infos_[view] == nullptr && !given_up_[view])
    {
      return false;
    }
  }
  return true;
}

bool ViewInput::hasCameraInfos() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return isCalibrated();
}

void ViewInput::deliver(std::vector<Synchronizer::Set> sets)
{
  for (Synchronizer::Set& set : sets)
  {
    on_frame_({std::move(set.payloads), set.spread_ns, std::chrono::steady_clock::now()});
  }
}

std::vector<sensor_msgs::CameraInfoConstPtr> ViewInput::cameraInfos() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return infos_;
}

std::vector<sensor_msgs::ImageConstPtr> ViewInput::masks() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return masks_;
}

ViewSynchronizerStatistics ViewInput::statistics() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return synchronizer_.statistics();
}

bool ViewInput::isAdmitted(std::size_t view, const ViewImage& image) const
{
  try
  {
    requireMessageSize(image.bytes(), parameters_.limits.message_mb,
                       describe(parameters_.array.views[view]) + ": the message",
                       "Publish smaller images, or raise max_message_size.");
    return true;
  }
  catch (const InputError& error)
  {
    on_refused_(error.what());
    return false;
  }
}

void ViewInput::imageCallback(std::size_t view, const ViewImage& image)
{
  if (!isAdmitted(view, image))
  {
    return;
  }
  std::vector<Synchronizer::Set> sets;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    heard_[view] = std::chrono::steady_clock::now();
    given_up_[view] = false;
    auto set = synchronizer_.add(view, static_cast<std::int64_t>(image.header().stamp.toNSec()), image);
    for (; set; set = synchronizer_.next())
    {
      sets.push_back(std::move(*set));
    }
  }
  deliver(std::move(sets));
}

void ViewInput::cameraInfoCallback(std::size_t view, const sensor_msgs::CameraInfoConstPtr& info)
{
  bool calibrated = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const bool calibrated_before = isCalibrated();
    infos_[view] = info;
    calibrated = !calibrated_before && isCalibrated();
  }
  if (calibrated)
  {
    on_calibrated_();
  }
}

}  // namespace light_field_depth
