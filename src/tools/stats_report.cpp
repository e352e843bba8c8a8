#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <topic_tools/shape_shifter.h>
#include <nlohmann/json.hpp>

#include "light_field_depth/LightFieldDepthStats.h"
#include "tools/tool_main.h"

namespace light_field_depth
{
namespace
{
constexpr double WAIT_FOR_CALLBACKS_S = 0.1;  // how late a signal is noticed at the most
constexpr std::uint32_t QUEUE_SIZE = 1000;    // no message of a short run is lost

struct ReportOptions
{
  std::string node = "light_field_depth";
  std::vector<std::string> products;
  std::string label;
  std::string output;
  double silence_s = 3.0;
  double timeout_s = 60.0;
};

/// Sums over the frames that were heard, and the last of them.
struct Heard
{
  std::size_t frames = 0;
  double conversion_ms = 0.0;
  double pipeline_ms = 0.0;
  double publication_ms = 0.0;
  std::map<std::string, double> stage_ms;
  LightFieldDepthStatsConstPtr last;
  std::chrono::steady_clock::time_point last_at;

  void add(const LightFieldDepthStatsConstPtr& stats)
  {
    ++frames;
    conversion_ms += stats->conversion_ms;
    pipeline_ms += stats->pipeline_ms;
    publication_ms += stats->publication_ms;
    for (std::size_t i = 0; i < std::min(stats->stage_names.size(), stats->stage_ms.size()); ++i)
    {
      stage_ms[stats->stage_names[i]] += stats->stage_ms[i];
    }
    last = stats;
    last_at = std::chrono::steady_clock::now();
  }
};

double secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Listens to the stats and the products until the node has been silent for a while.
/// @throw InputError when nothing comes
Heard listen(const ReportOptions& options)
{
  ros::NodeHandle node_handle(options.node);
  Heard heard;
  const boost::function<void(const LightFieldDepthStatsConstPtr&)> on_stats =
      [&](const LightFieldDepthStatsConstPtr& stats) { heard.add(stats); };
  const boost::function<void(const topic_tools::ShapeShifter::ConstPtr&)> on_product =
      [](const topic_tools::ShapeShifter::ConstPtr&) {};
  std::vector<ros::Subscriber> subscribers;
  subscribers.push_back(node_handle.subscribe<LightFieldDepthStats>("stats", QUEUE_SIZE, on_stats));
  for (const std::string& product : options.products)
  {
    subscribers.push_back(node_handle.subscribe<topic_tools::ShapeShifter>(product, 1, on_product));
  }
  const auto start = std::chrono::steady_clock::now();
  while (heard.frames == 0 || secondsSince(heard.last_at) < options.silence_s)
  {
    if (!ros::ok())
    {
      throw Cancelled();
    }
    if (heard.frames == 0 && secondsSince(start) > options.timeout_s)
    {
      throw InputError("No stats came from the node '" + options.node + "' within " +
                       std::to_string(static_cast<int>(options.timeout_s)) +
                       " s; see its output for the reason.");
    }
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(WAIT_FOR_CALLBACKS_S));
  }
  return heard;
}

nlohmann::json figuresOf(const Heard& heard, const ReportOptions& options)
{
  const LightFieldDepthStats& last = *heard.last;
  const auto frames = static_cast<double>(heard.frames);
  std::map<std::string, double> mean_stage_ms = heard.stage_ms;
  for (auto& stage : mean_stage_ms)
  {
    stage.second /= frames;
  }
  return {{"label", options.label},
          {"products", options.products},
          {"sets_complete", last.sets_complete},
          {"sets_incomplete", last.sets_incomplete},
          {"frames_published", last.frames_published},
          {"frames_dropped", last.frames_dropped},
          {"frames_failed", last.frames_failed},
          {"dense_clouds", last.dense_clouds_published},
          {"dense_cloud_latency_ms", last.dense_cloud_latency_ms},
          {"recent_frames", last.recent_frames},
          {"rate_hz", last.recent_rate_hz},
          {"latency_median_ms", last.recent_latency_median_ms},
          {"latency_p99_ms", last.recent_latency_p99_ms},
          {"latency_longest_ms", last.recent_latency_longest_ms},
          {"mean_conversion_ms", heard.conversion_ms / frames},
          {"mean_pipeline_ms", heard.pipeline_ms / frames},
          {"mean_publication_ms", heard.publication_ms / frames},
          {"mean_stage_ms", mean_stage_ms}};
}

/// The columns are those of scripts/bench_node.sh.
std::string tableRow(const nlohmann::json& figures, const Heard& heard)
{
  std::ostringstream text;
  const auto column = [&](const char* name, int digits)
  { text << " | " << std::fixed << std::setprecision(digits) << figures.at(name).get<double>(); };
  text << "| " << figures.at("label").get<std::string>() << " | " << heard.last->sets_complete << " | "
       << heard.last->frames_dropped + heard.last->sets_incomplete;
  column("rate_hz", 1);
  column("latency_median_ms", 0);
  column("latency_p99_ms", 0);
  column("latency_longest_ms", 0);
  column("mean_conversion_ms", 1);
  column("mean_pipeline_ms", 0);
  column("mean_publication_ms", 1);
  column("dense_clouds", 0);
  text << " |";
  return text.str();
}

void report(const ReportOptions& options)
{
  const Heard heard = listen(options);
  const nlohmann::json figures = figuresOf(heard, options);
  std::cout << tableRow(figures, heard) << std::endl;
  if (!options.output.empty())
  {
    std::ofstream file(options.output);
    file << figures.dump(2) << '\n';
    if (!file)
    {
      throw InputError("The file " + options.output + " cannot be written; check the folder's permissions.");
    }
  }
}

}  // namespace
}  // namespace light_field_depth

int main(int argc, char** argv)
{
  using namespace light_field_depth;
  ros::init(argc, argv, "stats_report", ros::init_options::AnonymousName);
  CLI::App app(
      "Listens to a depth node until it falls silent, then prints what its stats say of rate, latency and "
      "drops, as a row of a table.",
      "stats_report");
  ReportOptions options;
  app.add_option("--node", options.node, "Name of the depth node")->capture_default_str();
  app.add_option("--products", options.products,
                 "Results to listen to besides the stats, such as disparity and points2");
  app.add_option("--label", options.label, "First column of the row");
  app.add_option("--output", options.output, "JSON file for the same figures");
  app.add_option("--silence", options.silence_s, "Seconds without a frame after which it ends")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--timeout", options.timeout_s, "Seconds to wait for the first frame")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  return runTool(app, argc, argv, [&] { report(options); });
}
