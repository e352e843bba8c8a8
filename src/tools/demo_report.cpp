#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <stereo_msgs/DisparityImage.h>
#include <opencv2/imgcodecs.hpp>

#include "light_field_depth/LightFieldDepthStats.h"
#include "light_field_depth/evaluation/evaluation.h"
#include "light_field_depth/io/cloud_files.h"
#include "light_field_depth/io/disparity_image.h"
#include "light_field_depth/io/pfm.h"
#include "tools/tool_main.h"

namespace light_field_depth
{
namespace
{
constexpr double WAIT_FOR_CALLBACKS_S = 0.1;  // how late a signal is noticed at the most

struct ReportOptions
{
  std::string node = "light_field_depth";
  std::string output;
  std::string truth;
  double timeout_s = 60.0;
  std::size_t frames = 3;
};

/// What the node has published.
struct Received
{
  stereo_msgs::DisparityImageConstPtr disparity;
  sensor_msgs::PointCloud2ConstPtr cloud;
  std::vector<LightFieldDepthStatsConstPtr> stats;

  bool enough(std::size_t frames) const
  {
    return disparity != nullptr && cloud != nullptr && stats.size() >= frames;
  }
};

std::string missingFrom(const Received& received, const ReportOptions& options)
{
  const char* const what = received.stats.empty()          ? "no stats"
                           : received.disparity == nullptr ? "no disparity"
                           : received.cloud == nullptr     ? "no dense cloud"
                                                           : "too few frames";
  std::string text = "Within " + std::to_string(static_cast<int>(options.timeout_s)) + " s " + what +
                     " came from the node '" + options.node + "'; see its output for the reason.";
  return text;
}

/// Listens until there is enough of everything. @throw InputError after the timeout
Received receive(const ReportOptions& options)
{
  ros::NodeHandle node_handle(options.node);
  Received received;
  const boost::function<void(const stereo_msgs::DisparityImageConstPtr&)> on_disparity =
      [&](const stereo_msgs::DisparityImageConstPtr& message) { received.disparity = message; };
  const boost::function<void(const sensor_msgs::PointCloud2ConstPtr&)> on_cloud =
      [&](const sensor_msgs::PointCloud2ConstPtr& message) { received.cloud = message; };
  const boost::function<void(const LightFieldDepthStatsConstPtr&)> on_stats =
      [&](const LightFieldDepthStatsConstPtr& message) { received.stats.push_back(message); };
  const ros::Subscriber disparity =
      node_handle.subscribe<stereo_msgs::DisparityImage>("disparity", 1, on_disparity);
  const ros::Subscriber cloud = node_handle.subscribe<sensor_msgs::PointCloud2>("points_dense", 1, on_cloud);
  const ros::Subscriber stats = node_handle.subscribe<LightFieldDepthStats>("stats", 10, on_stats);

  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.timeout_s);
  while (!received.enough(options.frames))
  {
    if (!ros::ok())
    {
      throw Cancelled();
    }
    if (std::chrono::steady_clock::now() > deadline)
    {
      throw InputError(missingFrom(received, options));
    }
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(WAIT_FOR_CALLBACKS_S));
  }
  return received;
}

/// The disparity between the images: without the focus-plane offset, NaN where it is invalid.
cv::Mat imageDisparity(const stereo_msgs::DisparityImage& message, double disparity_offset_px)
{
  const cv::Mat published(static_cast<int>(message.image.height), static_cast<int>(message.image.width),
                          CV_32FC1, const_cast<std::uint8_t*>(message.image.data.data()), message.image.step);
  cv::Mat disparity = published - disparity_offset_px;
  disparity.setTo(std::numeric_limits<float>::quiet_NaN(), published < message.min_disparity);
  return disparity;
}

std::vector<ColoredPoint> pointsOf(const sensor_msgs::PointCloud2& cloud)
{
  if (cloud.point_step != sizeof(ColoredPoint))
  {
    throw InputError("The dense cloud has " + std::to_string(cloud.point_step) +
                     " bytes a point instead of " + std::to_string(sizeof(ColoredPoint)) +
                     "; node and tool are of different versions.");
  }
  std::vector<ColoredPoint> points(static_cast<std::size_t>(cloud.width) * cloud.height);
  std::memcpy(points.data(), cloud.data.data(), points.size() * sizeof(ColoredPoint));
  return points;
}

void printLatency(const std::vector<LightFieldDepthStatsConstPtr>& stats)
{
  std::vector<double> latencies_ms;
  latencies_ms.reserve(stats.size());
  for (const LightFieldDepthStatsConstPtr& frame : stats)
  {
    latencies_ms.push_back(frame->latency_ms);
  }
  std::sort(latencies_ms.begin(), latencies_ms.end());
  const LightFieldDepthStats& last = *stats.back();
  std::cout << "latency    " << latencies_ms[latencies_ms.size() / 2] << " ms (median of " << stats.size()
            << " frames, longest " << latencies_ms.back() << " ms), of which the pipeline "
            << last.pipeline_ms << " ms\n"
            << "method     " << last.method << ", " << last.views_used << " of " << last.views_expected
            << " views, range " << last.disparity_min << ".." << last.disparity_max << " px\n";
}

void report(const ReportOptions& options)
{
  const std::optional<cv::Mat> truth =
      options.truth.empty() ? std::nullopt : std::optional<cv::Mat>(readPfm(options.truth));
  const std::filesystem::path output(options.output);
  std::filesystem::create_directories(output);

  const Received received = receive(options);
  const cv::Mat disparity = imageDisparity(*received.disparity, received.stats.back()->disparity_offset);
  const std::string picture = (output / "disparity.png").string();
  if (!cv::imwrite(picture, disparityWithScale(disparity, shownRange(disparity))))
  {
    throw InputError("The file " + picture + " cannot be written; check the folder's permissions.");
  }
  const std::size_t points = writePly(output / "cloud.ply", pointsOf(*received.cloud));

  std::cout << std::fixed << std::setprecision(1);
  if (truth)
  {
    std::cout << "accuracy   " << toText(evaluate(disparity, *truth)) << "\n";
  }
  printLatency(received.stats);
  std::cout << "cloud      " << points << " points" << std::endl;
}

}  // namespace
}  // namespace light_field_depth

int main(int argc, char** argv)
{
  using namespace light_field_depth;
  ros::init(argc, argv, "demo_report", ros::init_options::AnonymousName);
  CLI::App app(
      "Waits for the results of a running depth node, writes disparity.png and cloud.ply, and prints their "
      "accuracy and latency.",
      "demo_report");
  ReportOptions options;
  app.add_option("--node", options.node, "Name of the depth node")->capture_default_str();
  app.add_option("--output", options.output, "Folder for the files")->required();
  app.add_option("--truth", options.truth, "PFM with the exact disparity of the reference view");
  app.add_option("--timeout", options.timeout_s, "Seconds to wait")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--frames", options.frames, "Frames to wait for")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  return runTool(app, argc, argv, [&] { report(options); });
}
