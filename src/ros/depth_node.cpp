#include "light_field_depth/ros/depth_node.h"

#include <utility>

#include <ros/console.h>
#include <ros/time.h>

#include "light_field_depth/core/error.h"
#include "light_field_depth/ros/input_report.h"

namespace light_field_depth
{
namespace
{
using SteadyTime = std::chrono::steady_clock::time_point;

const ros::WallDuration WATCH_PERIOD(1.0);
constexpr double NANOSECONDS_PER_MILLISECOND = 1e6;

double millisecondsBetween(SteadyTime from, SteadyTime to)
{
  return std::chrono::duration<double, std::milli>(to - from).count();
}

std::size_t queueCapacity(const NodeParameters& parameters)
{
  return parameters.keep_all ? static_cast<std::size_t>(parameters.keep_all_limit) : 1;
}

/// When the steps of one frame were done.
struct FrameTimes
{
  SteadyTime taken;
  SteadyTime assembled;
  SteadyTime computed;
  SteadyTime published;
};

LightFieldDepthStats frameStats(const FrameSet& set, const FrameTimes& times, const PipelineResult& result)
{
  LightFieldDepthStats stats;
  stats.views_expected = static_cast<std::uint32_t>(set.images.size());
  stats.views_used = static_cast<std::uint32_t>(result.estimate.views_used);
  stats.disparity_min = result.estimate.range.min;
  stats.disparity_max = result.estimate.range.max;
  stats.latency_ms = millisecondsBetween(set.arrival, times.published);
  stats.waiting_ms = millisecondsBetween(set.arrival, times.taken);
  stats.conversion_ms = millisecondsBetween(times.taken, times.assembled);
  stats.pipeline_ms = millisecondsBetween(times.assembled, times.computed);
  stats.publication_ms = millisecondsBetween(times.computed, times.published);
  stats.stamp_spread_ms = static_cast<double>(set.stamp_spread_ns) / NANOSECONDS_PER_MILLISECOND;
  for (const StageTime& time : result.stage_times)
  {
    stats.stage_names.push_back(time.stage);
    stats.stage_ms.push_back(time.milliseconds);
  }
  return stats;
}

void addInputCounts(const ViewSynchronizerStatistics& input, LightFieldDepthStats& stats)
{
  stats.sets_incomplete = input.sets_dropped;
  stats.time_jumps = input.time_jumps;
  for (const ViewCounts& counts : input.views)
  {
    stats.received_by_view.push_back(counts.received);
    stats.dropped_by_view.push_back(counts.dropped);
    stats.missing_by_view.push_back(counts.missing);
  }
}

ProductRequest productsFor(const Audience& audience, const NodeSettings& settings)
{
  ProductRequest request;
  request.depth = audience.depth;
  request.organized_cloud = audience.points2;
  request.dense_cloud = audience.points_dense && settings.dense_cloud;
  return request;
}

}  // namespace

DepthNode::DepthNode(const ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle)
    : parameters_(readNodeParameters(private_node_handle)), diagnostics_(node_handle, private_node_handle),
      settings_(private_node_handle, [this](const std::string& sentence) { diagnostics_.warn(sentence); }),
      queue_(queueCapacity(parameters_)),
      input_(
          node_handle, private_node_handle, parameters_,
          [this](FrameSet set) { queue_.push(std::move(set)); }, [this] { queue_.setHeldBack(false); }),
      assembler_(parameters_.array, parameters_.calibration, parameters_.use_camera_info),
      pipeline_(parameters_.threads)
{
  queue_.setHeldBack(parameters_.use_camera_info);
  {
    // A listener may come while the topics are being advertised; it waits here until all of them are.
    const std::lock_guard<std::mutex> lock(subscription_mutex_);
    results_ = std::make_unique<ResultPublisher>(private_node_handle, [this] { updateSubscriptions(); });
  }
  worker_ = std::thread([this] { workerLoop(); });
  updateSubscriptions();
  ros::NodeHandle services = private_node_handle;
  reset_service_ = services.advertiseService("reset", &DepthNode::reset, this);
  watch_timer_ = services.createSteadyTimer(WATCH_PERIOD, &DepthNode::watch, this);
  ROS_INFO_STREAM("Depth from " << parameters_.array.views.size() << " views, "
                                << parameters_.array.views.front().image << " to "
                                << parameters_.array.views.back().image << ", on " << pipeline_.threads()
                                << " thread(s).");
}

DepthNode::~DepthNode()
{
  {
    const std::lock_guard<std::mutex> lock(subscription_mutex_);
    shutting_down_ = true;
  }
  // The worker gives up its frame while the topics are being left, which takes a call to the master for each.
  pipeline_.cancel();
  queue_.stop();
  watch_timer_.stop();
  reset_service_.shutdown();
  input_.unsubscribe();
  worker_.join();
  results_->shutdown();
}

void DepthNode::updateSubscriptions()
{
  const std::lock_guard<std::mutex> lock(subscription_mutex_);
  if (shutting_down_)
  {
    return;
  }
  const bool wanted = !parameters_.lazy || results_->audience().any();
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

bool DepthNode::reset(std_srvs::Empty::Request& /*request*/, std_srvs::Empty::Response& /*response*/)
{
  queue_.setHeldBack(parameters_.use_camera_info);
  input_.forget();
  queue_.clear();
  return true;
}

void DepthNode::watch(const ros::SteadyTimerEvent& /*event*/)
{
  bool listening = false;
  {
    const std::lock_guard<std::mutex> lock(subscription_mutex_);
    listening = subscribed_;
  }
  const ViewSynchronizerStatistics heard = input_.statistics();
  const auto now = std::chrono::steady_clock::now();
  const bool waiting_for_calibration =
      parameters_.use_camera_info && queue_.waiting() > 0 && queue_.isHeldBack();
  const bool got_something = heard.sets_complete != heard_before_.sets_complete && !waiting_for_calibration;
  if (!listening || got_something || heard_before_.views.empty())
  {
    silent_since_ = now;
    heard_before_ = heard;
  }
  const double silent_s = std::chrono::duration<double>(now - silent_since_).count();
  if (silent_s >= parameters_.patience_s)
  {
    const auto infos =
        parameters_.use_camera_info ? input_.cameraInfos() : std::vector<sensor_msgs::CameraInfoConstPtr>();
    const std::string sentence =
        explainSilence(parameters_.array, heard_before_, heard, infos, parameters_.patience_s);
    if (!sentence.empty())
    {
      diagnostics_.warn(sentence);
    }
    silent_since_ = now;
    heard_before_ = heard;
  }
  diagnostics_.update(heard, queue_.dropped(), listening);
}

void DepthNode::workerLoop()
{
  while (const std::optional<FrameSet> set = queue_.pop())
  {
    processSafely(*set);
  }
}

void DepthNode::processSafely(const FrameSet& set)
{
  try
  {
    const Audience audience = results_->audience();
    if (audience.any())
    {
      process(set, audience);
    }
  }
  catch (const Cancelled&)
  {
    // The node is being destroyed.
  }
  catch (const std::exception& error)
  {
    diagnostics_.frameFailed(error.what());
  }
}

void DepthNode::process(const FrameSet& set, const Audience& audience)
{
  FrameTimes times;
  times.taken = std::chrono::steady_clock::now();
  const std::shared_ptr<const NodeSettings> settings = settings_.snapshot();
  const std::vector<sensor_msgs::CameraInfoConstPtr> infos = input_.cameraInfos();
  const LightField light_field = assembler_.assemble(set.images, infos);
  for (const std::string& warning : assembler_.warnings())
  {
    diagnostics_.warn(warning);
  }
  times.assembled = std::chrono::steady_clock::now();
  const PipelineResult result =
      pipeline_.run(light_field, settings->pipeline, productsFor(audience, *settings));
  times.computed = std::chrono::steady_clock::now();

  std_msgs::Header header = set.images[parameters_.array.reference]->header;
  if (!parameters_.frame_id.empty())
  {
    header.frame_id = parameters_.frame_id;
  }
  Audience served = audience;
  served.points_dense = audience.points_dense && settings->dense_cloud;
  results_->publish(header, served, light_field, result, settings->pipeline.min_confidence,
                    infos[parameters_.array.reference]);
  times.published = std::chrono::steady_clock::now();

  LightFieldDepthStats stats = frameStats(set, times, result);
  diagnostics_.framePublished(stats.latency_ms);
  if (audience.stats)
  {
    stats.header = header;
    stats.published = ros::Time::now();
    stats.disparity_offset = static_cast<float>(light_field.calibration->disparity_offset_px);
    stats.method = toString(settings->pipeline.method);
    stats.frames_published = diagnostics_.framesPublished();
    stats.frames_failed = diagnostics_.framesFailed();
    stats.frames_dropped = queue_.dropped();
    addInputCounts(input_.statistics(), stats);
    results_->publish(stats);
  }
}

}  // namespace light_field_depth
