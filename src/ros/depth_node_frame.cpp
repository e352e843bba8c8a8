// What DepthNode does with a set: its results, up to their publication.

#include <algorithm>
#include <utility>

#include <cv_bridge/cv_bridge.h>
#include <boost/make_shared.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/geometry.h"
#include "light_field_depth/core/memory_need.h"
#include "light_field_depth/ros/result_messages.h"
#include "light_field_depth/ros/view_messages.h"
#include "ros/depth_node_implementation.h"
#include "ros/view_frames.h"

namespace light_field_depth
{
namespace
{
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

}  // namespace

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

void DepthNode::Implementation::process(FrameSet set, const Subscribers& subscribers, bool asked_for)
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
  FrameDemand demand;
  demand.subscribers = subscribers;
  demand.everything = save_.exchange(false);
  RateLimit dense_cloud_rate = dense_cloud_rate_;
  demand.dense_cloud = subscribers.points_dense && settings->dense_cloud && light_field.calibration &&
                       dense_cloud_rate.isDue(header.stamp, settings->dense_cloud_max_rate_hz);
  const auto products = std::make_shared<FrameProducts>(compute(light_field, *settings, header, demand));
  broadcastViews(light_field, set, header);
  products->info = assembler_.referenceInfo();
  if (subscribers.reference_image)
  {
    products->image =
        imageMessageOf(set.images[parameters_.array.reference], light_field.reference().image, header);
  }
  report.computed = std::chrono::steady_clock::now();
  publication_.run(
      [this, products, report, save = demand.everything, settings]
      {
        publishSafely(*products, report);
        if (save)
        {
          saveSafely(*products, *settings);
        }
      });
  if (demand.dense_cloud)
  {
    const bool has_one = products->points_dense != nullptr ||
                         makeDenseCloud({header, set, light_field, settings, products->result.estimate},
                                        asked_for || parameters_.keep_all);
    dense_cloud_rate_ = has_one ? dense_cloud_rate : dense_cloud_rate_;
  }
  if (const auto doubts = result_watch_.look(light_field, products->result.estimate, report.computed))
  {
    diagnostics_.setDoubts(*doubts);
  }
}

FrameProducts DepthNode::Implementation::compute(const LightField& light_field, const NodeSettings& settings,
                                                 const std_msgs::Header& header, const FrameDemand& demand)
{
  const Subscribers& subscribers = demand.subscribers;
  const bool everything = demand.everything;
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
  request.dense_cloud = everything && settings.dense_cloud;
  request.dense_cloud_later = demand.dense_cloud && !everything;
  requireMemory({light_field.views.size(), light_field.size(), light_field.reference().image.type()},
                settings.pipeline, request, parameters_.max_memory_mb,
                "Use fewer views, reduce them (decimation), or raise max_memory.");
  if (everything)
  {
    // Into the result, which is saved; listeners get a copy.
    const PointAllocator points2 = std::exchange(request.organized_cloud_allocator, nullptr);
    products.result = pipeline_.run(light_field, settings.pipeline, request);
    copyIfWanted(products.result.organized_cloud, subscribers.points2, points2);
    if (demand.dense_cloud)
    {
      const std::vector<DensePoint>& points = products.result.dense_cloud;
      products.points_dense = boost::make_shared<sensor_msgs::PointCloud2>();
      beginDenseCloud(header, *products.points_dense);
      appendDensePoints(points.data(), points.size(),
                        thinningOfDenseCloud(light_field, settings.pipeline.dense_cloud),
                        *products.points_dense);
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

/// The cloud of a frame whose other results are on their way.
/// @param wait whether it has to be that of this frame, be it late
/// @return false if there will be none
bool DepthNode::Implementation::makeDenseCloud(FinishedFrame frame, bool wait)
{
  const bool taken =
      wait ? dense_cloud_maker_.queue(std::move(frame)) : dense_cloud_maker_.offer(std::move(frame));
  if (!taken)
  {
    diagnostics_.denseCloudSkipped();
  }
  return taken;
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

}  // namespace light_field_depth
