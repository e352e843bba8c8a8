// How DepthNode publishes: the results of a frame, and dense clouds when they are done.

#include <chrono>
#include <string>

#include <ros/time.h>

#include "light_field_depth/core/error.h"
#include "ros/depth_node_implementation.h"

namespace light_field_depth
{
namespace
{
constexpr double NANOSECONDS_PER_MILLISECOND = 1e6;

double millisecondsBetween(FrameReport::Time from, FrameReport::Time to)
{
  return std::chrono::duration<double, std::milli>(to - from).count();
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

/// The cloud in the target frame; null if tf has no way there.
sensor_msgs::PointCloud2Ptr DepthNode::Implementation::transformed(const sensor_msgs::PointCloud2Ptr& cloud)
{
  if (cloud_transformer_ == nullptr || cloud == nullptr)
  {
    return cloud;
  }
  try
  {
    return cloud_transformer_->transform(*cloud);
  }
  catch (const InputError& error)
  {
    diagnostics_.warn(error.what());
    return nullptr;
  }
}

/// On the thread of the maker of dense clouds.
void DepthNode::Implementation::publishDenseCloud(const FinishedFrame& frame,
                                                  const sensor_msgs::PointCloud2Ptr& cloud)
{
  if (const sensor_msgs::PointCloud2Ptr moved = transformed(cloud))
  {
    results_->publishDenseCloud(moved);
    diagnostics_.denseCloudPublished(
        millisecondsBetween(frame.set.arrival, std::chrono::steady_clock::now()));
  }
}

void DepthNode::Implementation::publishSafely(FrameProducts& products, FrameReport report)
{
  try
  {
    products.points2 = transformed(products.points2);
    products.points_dense = transformed(products.points_dense);
    results_->publish(products);
    report.published = std::chrono::steady_clock::now();
    const double latency_ms = millisecondsBetween(report.arrived, report.published);
    diagnostics_.framePublished(latency_ms);
    if (products.points_dense != nullptr)
    {
      diagnostics_.denseCloudPublished(latency_ms);
    }
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
  const DenseCloudCounts dense_clouds = diagnostics_.denseClouds();
  stats.dense_clouds_published = dense_clouds.published;
  stats.dense_clouds_skipped = dense_clouds.skipped;
  stats.dense_cloud_latency_ms = dense_clouds.last_latency_ms;
  return stats;
}

}  // namespace light_field_depth
