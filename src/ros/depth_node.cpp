#include "ros/depth_node_implementation.h"

#include <algorithm>
#include <new>
#include <utility>

#include <cv_bridge/cv_bridge.h>
#include <ros/console.h>
#include <ros/time.h>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/geometry.h"
#include "light_field_depth/core/memory_need.h"
#include "light_field_depth/ros/result_messages.h"
#include "light_field_depth/ros/view_messages.h"
#include "ros/view_frames.h"

namespace light_field_depth
{
namespace
{
const ros::WallDuration WATCH_PERIOD(1.0);
constexpr double NANOSECONDS_PER_MILLISECOND = 1e6;
constexpr const char* NO_MEMORY =
    "The memory does not suffice for a set; use fewer or smaller views (decimation).";

double millisecondsBetween(FrameReport::Time from, FrameReport::Time to)
{
  return std::chrono::duration<double, std::milli>(to - from).count();
}

/// The image that a view has in the light field: the message that came, if it is that, or a new one.
sensor_msgs::ImageConstPtr imageMessageOf(const ViewImage& received, const cv::Mat& used,
                                          const std_msgs::Header& header)
{
  const sensor_msgs::ImageConstPtr& raw = received.raw();
  if (raw != nullptr && raw->data.data() == used.data && raw->header.frame_id == header.frame_id)
  {
    return raw;
  }
  return cv_bridge::CvImage(header, encodingOf(used), used).toImageMsg();
}

AssemblerOptions assemblerOptions(const NodeParameters& parameters)
{
  AssemblerOptions options;
  options.use_camera_info = parameters.use_camera_info;
  options.rectify = parameters.rectify;
  options.mask_black = parameters.mask_black;
  options.decimation = parameters.decimation;
  return options;
}

void copyIfWanted(const std::vector<ColoredPoint>& points, bool wanted, const PointAllocator& room)
{
  if (wanted)
  {
    if (ColoredPoint* const copy = room(points.size()))
    {
      std::copy(points.begin(), points.end(), copy);
    }
  }
}

void addTimes(const FrameReport& report, const PipelineResult& result, LightFieldDepthStats& stats)
{
  stats.latency_ms = millisecondsBetween(report.arrived, report.published);
  stats.waiting_ms = millisecondsBetween(report.arrived, report.taken);
  stats.conversion_ms = millisecondsBetween(report.taken, report.assembled);
  stats.pipeline_ms = millisecondsBetween(report.assembled, report.computed);
  stats.publication_ms = millisecondsBetween(report.computed, report.published);
  stats.stamp_spread_ms = static_cast<double>(report.stamp_spread_ns) / NANOSECONDS_PER_MILLISECOND;
  for (const StageTime& time : result.stage_times)
  {
    stats.stage_names.push_back(time.stage);
    stats.stage_ms.push_back(time.milliseconds);
  }
}

void addRecent(const RecentFrames::Summary& recent, LightFieldDepthStats& stats)
{
  stats.recent_frames = static_cast<std::uint32_t>(recent.frames);
  stats.recent_rate_hz = recent.rate_hz;
  stats.recent_latency_median_ms = recent.median_ms;
  stats.recent_latency_p99_ms = recent.p99_ms;
  stats.recent_latency_longest_ms = recent.longest_ms;
}

void addInputCounts(const ViewSynchronizerStatistics& input, LightFieldDepthStats& stats)
{
  stats.sets_complete = input.sets_complete;
  stats.sets_partial = input.sets_partial;
  stats.sets_incomplete = input.sets_dropped;
  stats.time_jumps = input.time_jumps;
  for (const ViewCounts& counts : input.views)
  {
    stats.received_by_view.push_back(counts.received);
    stats.dropped_by_view.push_back(counts.dropped);
    stats.missing_by_view.push_back(counts.missing);
  }
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
          [this](FrameSet set) { queue_.push(std::move(set)); }, [this] { queue_.setHeldBack(false); }),
      pipeline_(parameters_.threads),
      assembler_(parameters_.array, parameters_.calibration, assemblerOptions(parameters_), pipeline_.pool()),
      result_watch_(parameters_.check_order),
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
  // The worker gives up its frame while the topics are being left, which takes a call to the master for each.
  pipeline_.cancel();
  queue_.stop();
  watch_timer_.stop();
  for (ros::ServiceServer& service : services_)
  {
    service.shutdown();
  }
  input_.unsubscribe();
  publication_.stop();  // before the worker ends, which may be waiting for it
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
      process(std::move(set), subscribers);
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

/// A camera that came back without its CameraInfo is left out where the others can stand for all.
void DepthNode::Implementation::dropUncalibratedViews(
    FrameSet& set, const std::vector<sensor_msgs::CameraInfoConstPtr>& infos)
{
  std::vector<bool> known(infos.size());
  for (std::size_t view = 0; view < infos.size(); ++view)
  {
    known[view] = set.images[view] && infos[view] != nullptr;
  }
  if (!parameters_.use_camera_info || !input_.quorum().isEnough(known))
  {
    return;
  }
  for (std::size_t view = 0; view < infos.size(); ++view)
  {
    if (set.images[view] && infos[view] == nullptr)
    {
      diagnostics_.warn(describe(parameters_.array.views[view]) + ": no CameraInfo has come on '" +
                        parameters_.array.views[view].camera_info +
                        "', so its images are not used; publish it.");
      set.images[view] = ViewImage();
    }
  }
}

void DepthNode::Implementation::warnOfMissingMasks(const FrameSet& set,
                                                   const std::vector<sensor_msgs::ImageConstPtr>& masks)
{
  for (std::size_t view = 0; view < masks.size(); ++view)
  {
    const ViewTopics& topics = parameters_.array.views[view];
    if (set.images[view] && masks[view] == nullptr && !topics.mask.empty())
    {
      diagnostics_.warn(describe(topics) + ": no mask has come on '" + topics.mask +
                        "', so the whole image counts; publish it latched.");
    }
  }
}

void DepthNode::Implementation::process(FrameSet set, const Subscribers& subscribers)
{
  FrameReport report;
  report.stamp_spread_ns = set.stamp_spread_ns;
  report.arrived = set.arrival;
  report.taken = std::chrono::steady_clock::now();
  const std::vector<sensor_msgs::CameraInfoConstPtr> infos = input_.cameraInfos();
  dropUncalibratedViews(set, infos);
  for (const ViewImage& image : set.images)
  {
    report.used_by_view.push_back(static_cast<bool>(image));
  }
  const std::vector<sensor_msgs::ImageConstPtr> masks = input_.masks();
  warnOfMissingMasks(set, masks);
  const LightField light_field = assembler_.assemble(set.images, infos, masks);
  for (const std::string& warning : assembler_.warnings())
  {
    diagnostics_.warn(warning);
  }
  report.assembled = std::chrono::steady_clock::now();

  std_msgs::Header header = set.images[parameters_.array.reference].header();
  if (!parameters_.frame_id.empty())
  {
    header.frame_id = parameters_.frame_id;
  }
  const std::shared_ptr<const NodeSettings> settings = settings_.snapshot();
  report.method = toString(settings->pipeline.method);
  if (forget_frames_.exchange(false))
  {
    pipeline_.forget();
  }
  {
    const std::lock_guard<std::mutex> lock(last_set_mutex_);
    last_set_ = set;
  }
  const bool save = save_.exchange(false);
  const auto products =
      std::make_shared<FrameProducts>(compute(light_field, *settings, header, subscribers, save));
  broadcastViews(light_field, set, header);
  products->info = assembler_.referenceInfo();
  if (subscribers.reference_image)
  {
    products->image =
        imageMessageOf(set.images[parameters_.array.reference], light_field.reference().image, header);
  }
  report.computed = std::chrono::steady_clock::now();
  publication_.run(
      [this, products, report, save, settings]
      {
        publishSafely(*products, report);
        if (save)
        {
          saveSafely(*products, *settings);
        }
      });
  if (const auto doubts = result_watch_.look(light_field, products->result.estimate, report.computed))
  {
    diagnostics_.setDoubts(*doubts);
  }
}

FrameProducts DepthNode::Implementation::compute(const LightField& light_field, const NodeSettings& settings,
                                                 const std_msgs::Header& header,
                                                 const Subscribers& subscribers, bool everything)
{
  FrameProducts products;
  products.header = header;
  products.subscribers = subscribers;
  products.calibration = light_field.calibration;
  products.min_confidence = settings.pipeline.min_confidence;
  products.keep_filled = settings.pipeline.keep_filled;

  ProductRequest request;
  request.depth = everything || subscribers.depth || subscribers.depth_mm;
  request.organized_cloud = everything || subscribers.points2;
  request.organized_cloud_allocator = leftOutWhenTooLarge(
      [&](std::size_t /*count*/)
      {
        const sensor_msgs::PointCloud2Ptr cloud = organized_clouds_.take();
        ColoredPoint* const points = shapeOrganizedCloud(header, light_field.size(), *cloud);
        products.points2 = cloud;
        return points;
      });
  const bool dense_cloud_due =
      subscribers.points_dense && dense_cloud_rate_.isDue(header.stamp, settings.dense_cloud_max_rate_hz);
  request.dense_cloud = (everything || dense_cloud_due) && settings.dense_cloud;
  const std::size_t most_points =
      light_field.views.size() * static_cast<std::size_t>(light_field.size().area());
  const std::size_t every_nth =
      settings.pipeline.dense_cloud.voxel_size_m > 0.0F ? 1 : thinningOfDenseCloud(most_points);
  if (request.dense_cloud && dense_cloud_due && light_field.calibration)
  {
    products.points_dense = dense_clouds_.take();
    beginDenseCloud(header, *products.points_dense);
  }
  const DensePointSink to_message = [&](const DensePoint* points, std::size_t count)
  { appendDensePoints(points, count, every_nth, *products.points_dense); };
  request.dense_cloud_sink = to_message;
  requireMemory({light_field.views.size(), light_field.size(), light_field.reference().image.type()},
                settings.pipeline, request, parameters_.max_memory_mb,
                "Use fewer views, reduce them (decimation), or raise max_memory.");
  if (everything)
  {
    // Into the result, which is saved; listeners get a copy.
    const PointAllocator points2 = std::exchange(request.organized_cloud_allocator, nullptr);
    request.dense_cloud_sink = nullptr;
    products.result = pipeline_.run(light_field, settings.pipeline, request);
    copyIfWanted(products.result.organized_cloud, subscribers.points2, points2);
    if (products.points_dense != nullptr)
    {
      to_message(products.result.dense_cloud.data(), products.result.dense_cloud.size());
    }
  }
  else
  {
    products.result = pipeline_.run(light_field, settings.pipeline, request);
  }
  if (products.calibration)
  {
    products.limited_disparity = limitDepth(products.result.estimate.disparity, *products.calibration,
                                            settings.pipeline.min_depth_m, settings.pipeline.max_depth_m);
  }
  return products;
}

/// A cloud that cannot be sent costs itself, not the other results.
PointAllocator DepthNode::Implementation::leftOutWhenTooLarge(PointAllocator allocator)
{
  return [this, allocator = std::move(allocator)](std::size_t count) -> ColoredPoint*
  {
    try
    {
      return allocator(count);
    }
    catch (const InputError& error)
    {
      diagnostics_.warn(error.what());
      return nullptr;
    }
  };
}

void DepthNode::Implementation::broadcastViews(const LightField& light_field, const FrameSet& set,
                                               const std_msgs::Header& header)
{
  if (!parameters_.publish_tf || !light_field.calibration)
  {
    return;
  }
  std::vector<std::string> image_frames;
  for (const ViewImage& image : set.images)
  {
    if (image)
    {
      image_frames.push_back(image.header().frame_id);
    }
  }
  std::vector<geometry_msgs::TransformStamped> frames =
      viewFrames(light_field, image_frames, header.frame_id);
  if (frames != view_frames_)
  {
    view_frames_ = frames;
    for (geometry_msgs::TransformStamped& frame : frames)
    {
      frame.header.stamp = header.stamp;
    }
    if (broadcaster_ == nullptr)
    {
      broadcaster_ = std::make_unique<tf2_ros::StaticTransformBroadcaster>();
    }
    broadcaster_->sendTransform(frames);
  }
}

void DepthNode::Implementation::transformClouds(FrameProducts& products)
{
  if (cloud_transformer_ == nullptr)
  {
    return;
  }
  for (sensor_msgs::PointCloud2Ptr* const cloud : {&products.points2, &products.points_dense})
  {
    try
    {
      *cloud = *cloud != nullptr ? cloud_transformer_->transform(**cloud) : nullptr;
    }
    catch (const InputError& error)
    {
      cloud->reset();
      diagnostics_.warn(error.what());
    }
  }
}

void DepthNode::Implementation::publishSafely(FrameProducts& products, FrameReport report)
{
  try
  {
    transformClouds(products);
    results_->publish(products);
    report.published = std::chrono::steady_clock::now();
    diagnostics_.framePublished(millisecondsBetween(report.arrived, report.published));
    if (products.subscribers.stats)
    {
      results_->publish(statsOf(products, report));
    }
  }
  catch (const std::exception& error)
  {
    diagnostics_.frameFailed(error.what());
  }
}

LightFieldDepthStats DepthNode::Implementation::statsOf(const FrameProducts& products,
                                                        const FrameReport& report) const
{
  const DisparityEstimate& estimate = products.result.estimate;
  LightFieldDepthStats stats;
  stats.header = products.header;
  stats.published = ros::Time::now();
  stats.method = report.method;
  stats.views_expected = static_cast<std::uint32_t>(report.used_by_view.size());
  stats.used_by_view.assign(report.used_by_view.begin(), report.used_by_view.end());
  stats.views_used = static_cast<std::uint32_t>(estimate.views_used);
  stats.disparity_min = estimate.range.min;
  stats.disparity_max = estimate.range.max;
  stats.disparity_offset =
      products.calibration ? static_cast<float>(products.calibration->disparity_offset_px) : 0.0F;
  addTimes(report, products.result, stats);
  addRecent(diagnostics_.recentFrames(), stats);
  stats.frames_published = diagnostics_.framesPublished();
  stats.frames_failed = diagnostics_.framesFailed();
  stats.frames_dropped = queue_.dropped();
  addInputCounts(input_.statistics(), stats);
  return stats;
}

DepthNode::DepthNode(const ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle,
                     ResultSaver saver)
    : implementation_(std::make_unique<Implementation>(node_handle, private_node_handle, std::move(saver)))
{
}

DepthNode::~DepthNode() = default;

}  // namespace light_field_depth
