#include "profile.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <nlohmann/json.hpp>

#include "core/multiview/search/label_space.h"
#include "light_field_depth/core/pipeline.h"
#include "machine_limits.h"
#include "scene.h"
#include "stage_work.h"
#include "timing.h"

namespace light_field_depth::benchmark
{
namespace
{
constexpr double BYTES_PER_MB = 1e6;
constexpr double PER_GIGA = 1e-9;
constexpr double SECONDS_PER_MS = 1e-3;
constexpr double PERCENT = 100.0;
constexpr int MAX_LABELS = 240;
constexpr double MIN_SHOWN_MS = 0.05;
const char* const REST = "the rest";

struct StageProfile
{
  std::string stage;
  Timing timing;
};

/// Stages in the order of the pipeline, the same for every frame, and what the frame takes besides them.
struct FrameProfile
{
  std::vector<StageProfile> stages;
  Timing total;
  DisparityEstimate estimate;

  void add(const PipelineResult& result)
  {
    double rest = result.total_ms;
    for (const StageTime& time : result.stage_times)
    {
      addTime(time.stage, time.milliseconds);
      rest -= time.milliseconds;
    }
    addTime(REST, rest);
    total.milliseconds.push_back(result.total_ms);
    estimate = result.estimate;
  }

private:
  void addTime(const std::string& stage, double milliseconds)
  {
    auto found = std::find_if(stages.begin(), stages.end(),
                              [&](const StageProfile& profile) { return profile.stage == stage; });
    if (found == stages.end())
    {
      stages.push_back({stage, {}});
      found = stages.end() - 1;
    }
    found->timing.milliseconds.push_back(milliseconds);
  }
};

struct Profiles
{
  FrameProfile one_thread;
  FrameProfile all_threads;
};

/// Frames on one thread and on all of them in turn.
Profiles measure(const Scene& scene, const Settings& settings)
{
  Pipeline one_thread(1);
  Pipeline all_threads(settings.threads);
  Profiles profiles;
  for (int i = 0; i <= settings.runs; ++i)
  {
    const PipelineResult alone = one_thread.run(scene.light_field, {}, {});
    const PipelineResult together = all_threads.run(scene.light_field, {}, {});
    if (i > 0)  // the first ones allocate
    {
      profiles.one_thread.add(alone);
      profiles.all_threads.add(together);
    }
  }
  return profiles;
}

/// @pre the light field is a cross of nine views or has one, so that its unit of disparity is the method's
FrameSize sizeOf(const Scene& scene, const DisparityEstimate& estimate)
{
  const MultiviewOptions options = withPresetNumbers({});
  const multiview::LabelSpace labels =
      multiview::makeLabelSpace(estimate.range, options.label_step_px, MAX_LABELS);
  FrameSize frame;
  frame.pixels = static_cast<double>(estimate.disparity.total());
  frame.views = static_cast<double>(estimate.views_used) - 1.0;
  frame.channels = scene.light_field.reference().image.channels();
  frame.labels = labels.count;
  frame.visibility_passes = options.visibility_passes;
  return frame;
}

double peakOf(Lane lane, const MachineLimits& limits)
{
  switch (lane)
  {
    case Lane::Byte:
      return limits.byte_gops;
    case Lane::Word:
      return limits.word_gops;
    case Lane::Float:
      return limits.float_gops;
    case Lane::None:
      break;
  }
  return 0.0;
}

/// "12.3 (45 %)" of a limit; empty where nothing was counted.
std::string rateText(double rate, double limit)
{
  return rate > 0.0 ? fixed(rate, 1) + " (" + fixed(PERCENT * rate / limit, 0) + " %)" : "";
}

void report(const StageProfile& profile, double alone_ms, double total_ms, const StageWork& work,
            const MachineLimits& limits, Table& table, nlohmann::json& json)
{
  const double milliseconds = profile.timing.median();
  const double seconds = milliseconds * SECONDS_PER_MS;
  const double gb_s = work.bytes * PER_GIGA / seconds;
  const double gops = work.operations * PER_GIGA / seconds;
  table.rows.push_back({profile.stage, fixed(milliseconds, 1),
                        fixed(PERCENT * milliseconds / total_ms, 0) + " %", fixed(alone_ms / milliseconds, 1),
                        work.bytes > 0.0 ? fixed(work.bytes / BYTES_PER_MB, 0) : "",
                        rateText(gb_s, limits.memory_triad_gb_s),
                        work.operations > 0.0 ? fixed(work.operations * PER_GIGA, 2) : "",
                        rateText(gops, peakOf(work.lane, limits))});
  nlohmann::json row;
  row["stage"] = profile.stage;
  row["time"] = toJson(profile.timing);
  row["one_thread_median_ms"] = alone_ms;
  row["bytes"] = work.bytes;
  row["operations"] = work.operations;
  row["peak_gops"] = peakOf(work.lane, limits);
  json["stages"].push_back(row);
}

}  // namespace

void profileFrame(const Settings& settings)
{
  const Scene scene = readScene(settings.inputs.back(), settings.threads);
  const auto [alone, profile] = measure(scene, settings);
  const MachineLimits limits = measureMachineLimits(settings.threads);
  const FrameSize frame = sizeOf(scene, profile.estimate);
  std::map<std::string, StageWork> work;
  for (const StageWork& stage : stageWork(frame))
  {
    work[stage.stage] = stage;
  }
  Table table;
  table.header = {"stage",           "ms",
                  "of the frame",    "x as fast as one thread",
                  "MB moved",        "GB/s (of memory's)",
                  "10^9 operations", "10^9 a second (of the peak)"};
  nlohmann::json json = describeMachine(settings);
  json["scene"] = scene.name;
  json["limits"] = toJson(limits);
  json["total"] = toJson(profile.total);
  json["total_one_thread"] = toJson(alone.total);
  for (std::size_t i = 0; i < profile.stages.size(); ++i)
  {
    const StageProfile& stage = profile.stages[i];
    if (stage.timing.median() >= MIN_SHOWN_MS)
    {
      report(stage, alone.stages[i].timing.median(), profile.total.median(), work[stage.stage], limits, table,
             json);
    }
  }
  table.rows.push_back({"frame", fixed(profile.total.median(), 1), "",
                        fixed(alone.total.median() / profile.total.median(), 1), "", "", "", ""});
  table.note = "`balanced` on " + scene.name + ", " + fixed(frame.views + 1.0, 0) + " views, " +
               fixed(frame.labels, 0) + " labels, " + std::to_string(settings.threads) +
               " threads, medians of " + std::to_string(settings.runs) + " frames. " + toText(limits);
  publish(settings, "profile", table, json);
}

}  // namespace light_field_depth::benchmark
