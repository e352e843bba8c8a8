#include "ros/depth_node_implementation.h"

#include <new>
#include <utility>

#include <ros/console.h>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
const ros::WallDuration WATCH_PERIOD(1.0);
constexpr const char* NO_MEMORY =
    "The memory does not suffice for a set; use fewer or smaller views (decimation).";

AssemblerOptions assemblerOptions(const NodeParameters& parameters)
{
  AssemblerOptions options;
  options.use_camera_info = parameters.use_camera_info;
  options.rectify = parameters.rectify;
  options.mask_black = parameters.mask_black;
  options.decimation = parameters.decimation;
  options.max_megapixels = parameters.limits.megapixels;
  return options;
}

}  // namespace

DepthNode::Implementation::Implementation(const ros::NodeHandle& node_handle,
                                          const ros::NodeHandle& private_node_handle, ResultSaver saver)
    : parameters_(readNodeParameters(private_node_handle)), saver_(std::move(saver)),
      diagnostics_(node_handle, private_node_handle),
      settings_(private_node_handle, [this](const std::string& sentence) { diagnostics_.warn(sentence); }),
      queue_(queueCapacity(parameters_)),
      input_(
          node_handle, private_node_handle, parameters_,
          [this](FrameSet set) { queue_.push(std::move(set)); }, [this] { queue_.setHeldBack(false); },
          [this](const std::string& sentence) { diagnostics_.warn(sentence); }),
      pipeline_(parameters_.threads),
      assembler_(parameters_.array, parameters_.calibration, assemblerOptions(parameters_), pipeline_.pool()),
      result_watch_(parameters_.check_order),
      dense_cloud_maker_(
          parameters_.threads,
          [this](const FinishedFrame& frame, const sensor_msgs::PointCloud2Ptr& cloud)
          { publishDenseCloud(frame, cloud); },
          [this](const std::string& sentence) { diagnostics_.warn(sentence); }),
      master_watch_([this](const std::string& sentence) { diagnostics_.error(sentence); }),
      health_(parameters_.array, parameters_.queue_size, parameters_.health)
{
  paused_ = parameters_.paused;
  if (!parameters_.target_frame.empty())
  {
    cloud_transformer_ = std::make_unique<CloudTransformer>(parameters_.target_frame);
  }
  for (const std::string& warning : parameters_.warnings)
  {
    diagnostics_.warn(warning);
  }
  queue_.setHeldBack(parameters_.use_camera_info && !input_.hasCameraInfos());
  {
    // A listener may come while the topics are being advertised; it waits here until all of them are.
    const std::lock_guard<std::mutex> lock(subscription_mutex_);
    results_ = std::make_unique<ResultPublisher>(private_node_handle, [this] { updateSubscriptions(); });
  }
  updateSubscriptions();
  advertiseServices(private_node_handle);
  watch_timer_ = private_node_handle.createSteadyTimer(WATCH_PERIOD, &Implementation::watch, this);
  ROS_INFO_STREAM("Depth from " << parameters_.array.views.size() << " views, "
                                << parameters_.array.views.front().image << " to "
                                << parameters_.array.views.back().image << ", on " << pipeline_.threads()
                                << " thread(s).");
  // Last, since a constructor that throws leaves nobody to join it.
  worker_ = std::thread([this] { workerLoop(); });
}

DepthNode::Implementation::~Implementation()
{
  {
    const std::lock_guard<std::mutex> lock(subscription_mutex_);
    shutting_down_ = true;
  }
  // Both give up what they have in hand while the topics are being left, which takes a call to the master for
  // each.
  pipeline_.cancel();
  dense_cloud_maker_.cancel();
  queue_.stop();
  watch_timer_.stop();
  for (ros::ServiceServer& service : services_)
  {
    service.shutdown();
  }
  input_.unsubscribe();
  // Before the worker ends, which may be waiting for them.
  publication_.stop();
  dense_cloud_maker_.stop();
  worker_.join();
  results_->shutdown();
}

void DepthNode::Implementation::updateSubscriptions()
{
  const std::lock_guard<std::mutex> lock(subscription_mutex_);
  if (shutting_down_)
  {
    return;
  }
  const bool wanted = once_ > 0 || (!paused_ && (!parameters_.lazy || results_->subscribers().any()));
  if (wanted && !subscribed_)
  {
    input_.subscribe();
  }
  else if (!wanted && subscribed_)
  {
    input_.unsubscribe();
    queue_.clear();
  }
  subscribed_ = wanted;
}

void DepthNode::Implementation::workerLoop()
{
  while (std::optional<FrameSet> set = queue_.pop())
  {
    processSafely(std::move(*set));
  }
}

void DepthNode::Implementation::processSafely(FrameSet set)
{
  try
  {
    const Subscribers subscribers = results_->subscribers();
    const bool asked_for = once_ > 0;
    if (asked_for || (!paused_ && subscribers.any()))
    {
      process(std::move(set), subscribers, asked_for);
      once_ -= asked_for ? 1 : 0;
    }
  }
  catch (const Cancelled&)
  {
    // The node is being destroyed.
  }
  catch (const std::bad_alloc&)
  {
    diagnostics_.frameFailed(NO_MEMORY);
  }
  catch (const cv::Exception& error)
  {
    diagnostics_.frameFailed(error.code == cv::Error::StsNoMem ? NO_MEMORY : error.what());
  }
  catch (const std::exception& error)
  {
    diagnostics_.frameFailed(error.what());
  }
}

DepthNode::DepthNode(const ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle,
                     ResultSaver saver)
    : implementation_(std::make_unique<Implementation>(node_handle, private_node_handle, std::move(saver)))
{
}

DepthNode::~DepthNode() = default;

}  // namespace light_field_depth
