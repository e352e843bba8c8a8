#include "scaling.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include <nlohmann/json.hpp>

#include "chart.h"
#include "layered_scene.h"
#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/io/image_files.h"
#include "timing.h"

namespace light_field_depth::benchmark
{
namespace
{
/// The exponent that growth with pixels, views and labels must not exceed.
constexpr double MAX_EXPONENT = 1.1;
constexpr int BASE_SIDE = 512;
constexpr int BASE_CROSS = 9;

/// One point of a series: how much there is of what grows, and a frame with that much.
struct Load
{
  double amount = 0.0;
  std::shared_ptr<const LightField> light_field;
  PipelineOptions options;
  int threads = 1;
};

struct Series
{
  std::string name;
  std::string unit;
  bool bounded = true;  ///< whether the exponent must not exceed MAX_EXPONENT
  std::vector<Load> loads;
};

std::shared_ptr<const LightField> sceneOf(int side, const std::vector<GridPosition>& positions)
{
  return std::make_shared<const LightField>(LayeredScene({side, side}).views(positions));
}

/// With the range given, so that it is not the search for it that grows.
PipelineOptions givenRange()
{
  PipelineOptions options;
  options.disparity_range = LAYERED_SCENE_RANGE;
  return options;
}

Series overPixels(const Settings& settings, bool range_given)
{
  Series series{range_given ? "pixels" : "pixels, range found", "pixels", true, {}};
  for (const int side : {256, 362, 512, 724, 1024, 1448, 2048})
  {
    series.loads.push_back({static_cast<double>(side) * side, sceneOf(side, crossOf(BASE_CROSS)),
                            range_given ? givenRange() : PipelineOptions(), settings.threads});
  }
  return series;
}

Series overViews(const Settings& settings)
{
  Series series{"views", "views", true, {}};
  const std::vector<std::vector<GridPosition>> arrays = {crossOf(3), crossOf(5), crossOf(9), gridOf(5),
                                                         gridOf(7),  gridOf(9),  gridOf(13), gridOf(17)};
  for (const auto& positions : arrays)
  {
    PipelineOptions options = givenRange();
    options.views = ViewSelection::All;
    series.loads.push_back(
        {static_cast<double>(positions.size()), sceneOf(BASE_SIDE, positions), options, settings.threads});
  }
  return series;
}

Series overLabels(const Settings& settings)
{
  Series series{"labels", "labels", true, {}};
  const auto scene = sceneOf(BASE_SIDE, crossOf(BASE_CROSS));
  for (const int labels : {16, 32, 64, 128, 240})
  {
    PipelineOptions options;
    const float step_px = withPresetNumbers(options.multiview).label_step_px;
    const int first = -labels / 2;
    options.disparity_range =
        DisparityRange{step_px * static_cast<float>(first), step_px * static_cast<float>(first + labels - 1)};
    series.loads.push_back({static_cast<double>(labels), scene, options, settings.threads});
  }
  return series;
}

Series overThreads()
{
  Series series{"threads", "threads", false, {}};
  const auto scene = sceneOf(BASE_SIDE, crossOf(BASE_CROSS));
  const auto processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (int threads = 1; threads < processors; threads *= 2)
  {
    series.loads.push_back({static_cast<double>(threads), scene, givenRange(), threads});
  }
  series.loads.push_back({static_cast<double>(processors), scene, givenRange(), processors});
  return series;
}

Chart measure(const Series& series, int rounds)
{
  std::vector<std::function<void()>> tasks;
  for (const Load& load : series.loads)
  {
    tasks.emplace_back([&load, pipeline = std::make_shared<Pipeline>(load.threads)]
                       { pipeline->run(*load.light_field, load.options, {}); });
  }
  const std::vector<Timing> timings = timeInRounds(tasks, rounds);
  Chart chart;
  chart.title = "time over " + series.name;
  chart.x_name = series.unit;
  chart.y_name = "ms";
  for (std::size_t i = 0; i < timings.size(); ++i)
  {
    chart.points.push_back(
        {series.loads[i].amount, timings[i].median(), timings[i].fastest(), timings[i].slowest()});
  }
  chart.fit = chart.points.size() > 1 ? fitPowerLaw(chart.points) : PowerLaw{};
  return chart;
}

void report(const Series& series, const Chart& chart, Table& table, nlohmann::json& json)
{
  nlohmann::json entry;
  entry["series"] = series.name;
  entry["exponent"] = chart.fit.exponent;
  std::string times;
  for (const ChartPoint& point : chart.points)
  {
    times += (times.empty() ? "" : ", ") + fixed(point.x, 0) + ": " + fixed(point.y, 0);
    entry["points"].push_back({{series.unit, point.x},
                               {"median_ms", point.y},
                               {"min_ms", point.lowest},
                               {"max_ms", point.highest}});
  }
  std::string verdict = "";
  if (series.bounded)
  {
    const bool within = chart.fit.exponent <= MAX_EXPONENT;
    entry["largest_exponent"] = MAX_EXPONENT;
    entry["within"] = within;
    verdict = within ? "yes" : "NO";
  }
  table.rows.push_back({series.name, times, fixed(chart.fit.exponent, 2), verdict});
  json["series"].push_back(entry);
}

}  // namespace

void measureGrowth(const Settings& settings)
{
  Table table;
  table.header = {"time over", "median ms", "exponent", "at most " + fixed(MAX_EXPONENT, 1)};
  table.note =
      "512 x 512 pixels, 17 views on a cross, and the range given unless the row says otherwise. Of more "
      "than "
      "eight views in one of eight directions the method uses eight.";
  nlohmann::json json = describeMachine(settings);
  std::vector<Chart> charts;
  const std::vector<std::function<Series()>> all = {
      [&] { return overPixels(settings, true); }, [&] { return overPixels(settings, false); },
      [&] { return overViews(settings); }, [&] { return overLabels(settings); }, overThreads};
  for (const auto& make : all)
  {
    const Series series = make();
    charts.push_back(measure(series, settings.runs));
    report(series, charts.back(), table, json);
  }
  publish(settings, "scaling", table, json);
  if (!settings.results.empty())
  {
    writeImage(std::filesystem::path(settings.results) / "scaling.png", drawCharts(charts));
  }
}

}  // namespace light_field_depth::benchmark
