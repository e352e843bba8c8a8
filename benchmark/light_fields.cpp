#include "light_fields.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <utility>

#include <nlohmann/json.hpp>

#include "contestant.h"
#include "opencv_baselines.h"

namespace light_field_depth::benchmark
{
namespace
{
const std::vector<Variant>& presets()
{
  static const std::vector<Variant> variants = {
      {"quality", {"multiview_preset=quality"}},
      {"balanced", {"multiview_preset=balanced"}},
      {"realtime", {"multiview_preset=realtime"}},
      {"realtime, temporal", {"multiview_preset=realtime", "multiview_temporal=true"}},
      {"fast", {"multiview_preset=fast"}},
  };
  return variants;
}

}  // namespace

const std::vector<Variant>& ownMethods()
{
  static const std::vector<Variant> methods = []
  {
    std::vector<Variant> all = presets();
    all.push_back({"paper2017", {"method=paper2017"}});
    return all;
  }();
  return methods;
}

namespace
{
/// What the others are compared with.
constexpr const char* YARDSTICK = "OpenCV DIS, median of 16";

/// The stereo matchers of OpenCV need to be told a range and get the true one; the others find it.
std::vector<Contestant> openCvMethods(const DisparityRange& range)
{
  return {{YARDSTICK,
           [](const LightField& light_field) {
             return Answer{disMedian(light_field), {}};
           }},
          {"OpenCV SGBM, widest pair",
           [range](const LightField& light_field) {
             return Answer{semiGlobalWidestPair(light_field, range), {}};
           }},
          {"OpenCV BM, widest pair", [range](const LightField& light_field) {
             return Answer{blockMatchingWidestPair(light_field, range), {}};
           }}};
}

/// How often a method would have been done while the yardstick ran once; taken round by round, so that a
/// machine that changes its speed does not change it.
double speedup(const Result& yardstick, const Result& result)
{
  std::vector<double> ratios;
  for (std::size_t i = 0; i < result.timing.milliseconds.size(); ++i)
  {
    ratios.push_back(yardstick.timing.milliseconds[i] / result.timing.milliseconds[i]);
  }
  return median(std::move(ratios));
}

void report(const std::vector<Result>& results, Table& table, nlohmann::json& rows)
{
  const auto yardstick = std::find_if(results.begin(), results.end(),
                                      [](const Result& result) { return result.name == YARDSTICK; });
  for (const Result& result : results)
  {
    const Evaluation& accuracy = result.evaluation;
    const double faster = speedup(*yardstick, result);
    const double mse_ratio = accuracy.mse_100 / yardstick->evaluation.mse_100;
    table.rows.push_back({result.scene, result.name, toText(result.timing), fixed(faster, 1),
                          fixed(accuracy.mse_100, 2), fixed(mse_ratio, 2), fixed(accuracy.badpix_007, 2),
                          fixed(accuracy.badpix_003, 1), fixed(accuracy.coverage, 2)});
    nlohmann::json row;
    row["scene"] = result.scene;
    row["method"] = result.name;
    row["time"] = toJson(result.timing);
    row["times_as_fast_as_dis"] = faster;
    row["accuracy"] = accuracyJson(result);
    row["mse_to_that_of_dis"] = mse_ratio;
    rows.push_back(row);
  }
}

/// What is left when a tenth of the pixels is dropped, and of that the ideal.
std::string tenthText(const SparsificationCurve& curve, int decimals)
{
  const double ideal = curve.ideal[SPARSIFICATION_STEPS / 10];
  return fixed(curve.error.front(), decimals) + " -> " + fixed(withoutLeastConfidentTenth(curve), decimals) +
         " (" + fixed(ideal, decimals) + ")";
}

void reportConfidence(const std::vector<Result>& results, Table& table)
{
  for (const Result& result : results)
  {
    if (result.sparsification)
    {
      const SparsificationCurve& mse = result.sparsification->mse_100;
      const SparsificationCurve& badpix = result.sparsification->badpix_007;
      table.rows.push_back({result.scene, result.name, tenthText(mse, 3), fixed(mse.ause, 3),
                            tenthText(badpix, 2), fixed(badpix.ause, 3)});
    }
  }
}

/// Each with a pipeline, threads and buffers of its own.
std::vector<Contestant> contestantsOf(const std::vector<Variant>& variants, int threads)
{
  std::vector<Contestant> own;
  for (const Variant& variant : variants)
  {
    own.push_back(makeContestant(variant, std::make_shared<Pipeline>(threads)));
  }
  return own;
}

}  // namespace

void measurePresets(const Settings& settings)
{
  Table table;
  table.header = {"scene",         "method",       "time, median (min..max) ms", "processor ms", "MSE x 100",
                  "BadPix 0.07 %", "BadPix 0.03 %"};
  nlohmann::json json = describeMachine(settings);
  const std::vector<Contestant> contestants = contestantsOf(presets(), settings.threads);
  for (const std::string& input : settings.inputs)
  {
    const Scene scene = readScene(input, settings.threads);
    for (const Result& result : measure(scene, contestants, settings.runs))
    {
      const Evaluation& accuracy = result.evaluation;
      table.rows.push_back({result.scene, result.name, toText(result.timing),
                            fixed(median(result.timing.processor_milliseconds), 1),
                            fixed(accuracy.mse_100, 3), fixed(accuracy.badpix_007, 2),
                            fixed(accuracy.badpix_003, 2)});
      nlohmann::json row;
      row["scene"] = result.scene;
      row["method"] = result.name;
      row["time"] = toJson(result.timing);
      row["accuracy"] = accuracyJson(result);
      json["rows"].push_back(row);
    }
  }
  publish(settings, "presets", table, json);
}

void compareMethods(const Settings& settings)
{
  Table table;
  table.header = {"scene",
                  "method",
                  "time, median (min..max) ms",
                  "x as fast as DIS",
                  "MSE x 100",
                  "MSE / that of DIS",
                  "BadPix 0.07 %",
                  "BadPix 0.03 %",
                  "coverage"};
  Table confidence;
  confidence.header = {"scene",
                       "method",
                       "MSE x 100 without a tenth (ideal)",
                       "AUSE of MSE",
                       "BadPix 0.07 % without a tenth (ideal)",
                       "AUSE of BadPix"};
  nlohmann::json json = describeMachine(settings);
  const std::vector<Contestant> own = contestantsOf(ownMethods(), settings.threads);
  for (const std::string& input : settings.inputs)
  {
    const Scene scene = readScene(input, settings.threads);
    std::vector<Contestant> all = own;
    for (Contestant& contestant : openCvMethods(rangeOf(scene.truth)))
    {
      all.push_back(std::move(contestant));
    }
    const std::vector<Result> results = measure(scene, all, settings.runs);
    report(results, table, json["rows"]);
    reportConfidence(results, confidence);
  }
  publish(settings, "light_fields", table, json);
  std::cout << '\n';
  publishTable(settings, "confidence", confidence);
}

}  // namespace light_field_depth::benchmark
