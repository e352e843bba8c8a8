#include "contestant.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/pipeline_options_io.h"

namespace light_field_depth::benchmark
{
namespace
{
void score(const Answer& answer, const Scene& scene, Result& result)
{
  result.evaluation = evaluate(answer.disparity, scene.truth);
  if (!answer.confidence.empty())
  {
    result.sparsification = sparsify(answer.disparity, answer.confidence, scene.truth);
  }
}

}  // namespace

PipelineOptions optionsOf(const Variant& variant)
{
  PipelineOptions options;
  for (const std::string& setting : variant.settings)
  {
    setOption(options, setting);
  }
  const std::vector<std::string> problems = validate(options);
  if (!problems.empty())
  {
    throw InputError("The variant '" + variant.name + "' cannot be run: " + problems.front());
  }
  return options;
}

Contestant makeContestant(const Variant& variant, std::shared_ptr<Pipeline> pipeline)
{
  return {variant.name,
          [pipeline = std::move(pipeline), options = optionsOf(variant)](const LightField& light_field)
          {
            const PipelineResult result = pipeline->run(light_field, options, {});
            return Answer{result.estimate.disparity, result.estimate.confidence};
          }};
}

nlohmann::json accuracyJson(const Result& result)
{
  auto json = nlohmann::json::parse(toJson(result.evaluation));
  if (result.sparsification)
  {
    json["sparsification"] = nlohmann::json::parse(toJson(*result.sparsification));
  }
  return json;
}

std::vector<Result> measure(const Scene& scene, const std::vector<Contestant>& contestants, int rounds)
{
  std::vector<Answer> answers(contestants.size());
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < contestants.size(); ++i)
  {
    tasks.emplace_back([&, i] { answers[i] = contestants[i].run(scene.light_field); });
  }
  const std::vector<Timing> timings = timeInRounds(tasks, rounds);
  std::vector<Result> results;
  results.reserve(contestants.size());
  for (std::size_t i = 0; i < contestants.size(); ++i)
  {
    results.push_back({scene.name, contestants[i].name, timings[i], {}, {}});
    score(answers[i], scene, results.back());
  }
  return results;
}

}  // namespace light_field_depth::benchmark
