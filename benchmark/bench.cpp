// Accuracy and time of whole light fields, side by side with what OpenCV offers, in one run.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/io/dataset.h"
#include "light_field_depth/io/evaluation.h"
#include "light_field_depth/io/pfm.h"
#include "opencv_baselines.h"

namespace light_field_depth::benchmark
{
namespace
{
namespace fs = std::filesystem;

struct Settings
{
  std::vector<std::string> inputs;
  std::string output;
  int runs = 9;
  int threads = 2;
};

/// Something that makes a disparity map of a light field.
struct Contestant
{
  std::string name;
  std::function<cv::Mat(const Dataset&)> run;
};

struct Row
{
  std::string scene;
  std::string method;
  std::vector<double> milliseconds;
  Evaluation evaluation;
};

double median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The range that the stereo matchers of OpenCV need to be told: the true one. Our own methods are not told.
DisparityRange trueRange(const cv::Mat& truth)
{
  double minimum = 0.0;
  double maximum = 0.0;
  cv::minMaxIdx(truth, &minimum, &maximum);
  return {static_cast<float>(minimum), static_cast<float>(maximum)};
}

std::vector<Contestant> contestants(Pipeline& pipeline, const DisparityRange& range)
{
  std::vector<Contestant> all;
  for (const std::string& name : methodNames())
  {
    PipelineOptions options;
    options.method = methodFromString(name);
    all.push_back({name, [&pipeline, options](const Dataset& dataset)
                   { return pipeline.run(dataset.light_field, options, {}).estimate.disparity; }});
  }
  all.push_back(
      {"OpenCV DIS, median", [](const Dataset& dataset) { return disMedian(dataset.light_field); }});
  all.push_back({"OpenCV SGBM, widest pair", [range](const Dataset& dataset)
                 { return semiGlobalWidestPair(dataset.light_field, range); }});
  all.push_back({"OpenCV BM, widest pair", [range](const Dataset& dataset)
                 { return blockMatchingWidestPair(dataset.light_field, range); }});
  return all;
}

/// Runs every contestant once per round, so that a machine that changes its speed changes it for all.
std::vector<Row> measure(const fs::path& input, const Settings& settings, Pipeline& pipeline)
{
  DatasetOptions options;
  options.threads = settings.threads;
  const Dataset dataset = readDataset(input, options);
  if (!dataset.truth)
  {
    throw InputError("The folder '" + input.string() + "' has no disparity truth; the benchmark needs one.");
  }
  const cv::Mat truth = readPfm(*dataset.truth);
  const std::vector<Contestant> all = contestants(pipeline, trueRange(truth));
  std::vector<Row> rows;
  for (const Contestant& contestant : all)
  {
    rows.push_back({input.filename().string(), contestant.name, {}, {}});
  }
  for (int round = 0; round <= settings.runs; ++round)
  {
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      const auto start = std::chrono::steady_clock::now();
      const cv::Mat disparity = all[i].run(dataset);
      const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
      if (round == 0)  // warms up, and gives the accuracy
      {
        rows[i].evaluation = evaluate(disparity, truth);
        continue;
      }
      rows[i].milliseconds.push_back(elapsed.count());
    }
  }
  return rows;
}

void printTable(const std::vector<Row>& rows)
{
  std::printf(
      "| scene | method | time, median (min..max) ms | MSE x 100 | BadPix 0.07 %% | BadPix 0.03 %% | "
      "coverage |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows)
  {
    const auto [fastest, slowest] = std::minmax_element(row.milliseconds.begin(), row.milliseconds.end());
    std::printf("| %s | %s | %.0f (%.0f..%.0f) | %.2f | %.2f | %.1f | %.2f |\n", row.scene.c_str(),
                row.method.c_str(), median(row.milliseconds), *fastest, *slowest, row.evaluation.mse_100,
                row.evaluation.badpix_007, row.evaluation.badpix_003, row.evaluation.coverage);
  }
}

void writeJson(const std::vector<Row>& rows, const Settings& settings)
{
  nlohmann::ordered_json report;
  report["threads"] = settings.threads;
  report["processors"] = std::thread::hardware_concurrency();
  report["runs"] = settings.runs;
  for (const Row& row : rows)
  {
    nlohmann::ordered_json entry;
    entry["scene"] = row.scene;
    entry["method"] = row.method;
    entry["median_ms"] = median(row.milliseconds);
    entry["all_ms"] = row.milliseconds;
    entry["accuracy"] = nlohmann::ordered_json::parse(toJson(row.evaluation));
    report["rows"].push_back(entry);
  }
  std::ofstream file(settings.output);
  file << report.dump(2) << '\n';
  if (!file)
  {
    throw InputError("The report could not be written to '" + settings.output + "'; check the folder.");
  }
}

int run(int argc, char** argv)
{
  CLI::App app{"Times and scores whole light fields, beside OpenCV's own methods, in one run."};
  Settings settings;
  app.add_option("--input", settings.inputs, "folders with a light field and its true disparity")->required();
  app.add_option("--runs", settings.runs, "timed runs of each method")
      ->capture_default_str()
      ->check(CLI::Range(1, 999));
  app.add_option("--threads", settings.threads, "threads of every method")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  app.add_option("--output", settings.output, "JSON file for the figures");
  CLI11_PARSE(app, argc, argv);

  cv::setNumThreads(settings.threads);
  Pipeline pipeline(settings.threads);
  std::vector<Row> rows;
  for (const std::string& input : settings.inputs)
  {
    std::vector<Row> more = measure(input, settings, pipeline);
    std::move(more.begin(), more.end(), std::back_inserter(rows));
  }
  printTable(rows);
  if (!settings.output.empty())
  {
    writeJson(rows, settings);
  }
  return 0;
}

}  // namespace
}  // namespace light_field_depth::benchmark

int main(int argc, char** argv)
{
  try
  {
    return light_field_depth::benchmark::run(argc, argv);
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
