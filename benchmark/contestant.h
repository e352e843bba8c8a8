#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_CONTESTANT_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_CONTESTANT_H

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/evaluation/evaluation.h"
#include "light_field_depth/evaluation/sparsification.h"
#include "scene.h"
#include "timing.h"

namespace light_field_depth::benchmark
{
/// A run of the pipeline: a name for the table, and its settings as "NAME=VALUE", as --set takes them.
struct Variant
{
  std::string name;
  std::vector<std::string> settings;
};

/// @throw InputError if there is no such setting or the value does not fit
PipelineOptions optionsOf(const Variant& variant);

struct Answer
{
  cv::Mat disparity;   ///< CV_32FC1, NaN where the method has no answer
  cv::Mat confidence;  ///< CV_32FC1, or empty where the method has none
};

/// Something that makes a disparity map of a light field, again and again.
struct Contestant
{
  std::string name;
  std::function<Answer(const LightField&)> run;
};

/// The pipeline with these settings. The pipeline object, with its threads and buffers, lives as long as the
/// contestant; contestants may share one.
Contestant makeContestant(const Variant& variant, std::shared_ptr<Pipeline> pipeline);

/// What one contestant did with one scene.
struct Result
{
  std::string scene;
  std::string name;
  Timing timing;
  Evaluation evaluation;
  std::optional<Sparsification> sparsification;  ///< only of methods that tell their confidence
};

/// What both tables say about accuracy, in one object.
nlohmann::json accuracyJson(const Result& result);

/// Times all contestants in rounds, and scores their last answers.
std::vector<Result> measure(const Scene& scene, const std::vector<Contestant>& contestants, int rounds);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_CONTESTANT_H
