#include "captures.h"

#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "contestant.h"
#include "light_field_depth/core/thread_pool.h"
#include "light_field_depth/evaluation/photometric_error.h"
#include "light_field_depth/evaluation/roughness.h"
#include "light_field_depth/io/dataset.h"
#include "light_fields.h"
#include "opencv_baselines.h"
#include "timing.h"

namespace light_field_depth::benchmark
{
namespace
{
/// "FOLDER" or "FOLDER,FLIP".
Dataset readCapture(const std::string& text, int threads)
{
  const std::size_t comma = text.rfind(',');
  DatasetOptions options;
  options.threads = threads;
  if (comma != std::string::npos)
  {
    options.flip = flipFromString(text.substr(comma + 1));
  }
  return readDataset(text.substr(0, comma), options);
}

std::vector<Contestant> contestants(int threads)
{
  std::vector<Contestant> all;
  for (const Variant& variant : ownMethods())
  {
    all.push_back(makeContestant(variant, std::make_shared<Pipeline>(threads)));
  }
  all.push_back({"OpenCV DIS, median over the cross", [](const LightField& light_field) {
                   return Answer{disMedian(light_field), {}};
                 }});
  return all;
}

void report(const std::string& capture, const LightField& light_field, const std::vector<Contestant>& methods,
            const Settings& settings, Table& table, nlohmann::json& json)
{
  std::vector<Answer> answers(methods.size());
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < methods.size(); ++i)
  {
    tasks.emplace_back([&, i] { answers[i] = methods[i].run(light_field); });
  }
  const std::vector<Timing> timings = timeInRounds(tasks, settings.runs);
  ThreadPool pool(settings.threads);
  for (std::size_t i = 0; i < methods.size(); ++i)
  {
    const PhotometricError error = photometricError(light_field, answers[i].disparity, pool);
    const double rough_px = roughness(answers[i].disparity, light_field.reference().image);
    table.rows.push_back({capture, methods[i].name, toText(timings[i]), fixed(error.mean, 2),
                          fixed(error.mean_of_medians, 2), fixed(rough_px, 3)});
    json["rows"].push_back({{"capture", capture},
                            {"method", methods[i].name},
                            {"time", toJson(timings[i])},
                            {"photometric_error", error.mean},
                            {"photometric_error_of_medians", error.mean_of_medians},
                            {"roughness_px", rough_px}});
  }
}

}  // namespace

void measureCaptures(const Settings& settings)
{
  if (settings.captures.empty())
  {
    std::cerr << "No captures are given (--capture), so none are measured.\n";
    return;
  }
  Table table;
  table.header = {
      "capture",     "method", "time, median (min..max) ms", "photometric error", "of medians over the views",
      "roughness px"};
  table.note =
      "Mean absolute difference of all views, warped to the reference view, in 8-bit levels; the first "
      "counts "
      "occlusions as errors. Roughness: root mean square of the map about its Gaussian of 8 px, in the "
      "calmest "
      "30 % of the image.";
  nlohmann::json json = describeMachine(settings);
  const std::vector<Contestant> methods = contestants(settings.threads);
  for (const std::string& capture : settings.captures)
  {
    const Dataset dataset = readCapture(capture, settings.threads);
    const std::string name = std::filesystem::path(capture.substr(0, capture.rfind(','))).filename();
    report(name, dataset.light_field, methods, settings, table, json);
  }
  publish(settings, "captures", table, json);
}

}  // namespace light_field_depth::benchmark
