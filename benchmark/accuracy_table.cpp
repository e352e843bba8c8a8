#include "accuracy_table.h"

#include <algorithm>
#include <utility>

namespace light_field_depth::benchmark
{
namespace
{
std::string accuracyText(const Evaluation& accuracy)
{
  return fixed(accuracy.mse_100, 3) + " / " + fixed(accuracy.badpix_007, 2) + " / " +
         fixed(accuracy.badpix_003, 1);
}

}  // namespace

AccuracyTable::AccuracyTable(const Settings& settings, std::string what, const std::vector<std::string>& rows)
    : settings_(settings), what_(std::move(what)), json_(describeMachine(settings))
{
  table_.header = {what_};
  for (const std::string& row : rows)
  {
    table_.rows.push_back({row});
  }
}

void AccuracyTable::add(const std::string& scene, const std::vector<Result>& results)
{
  table_.header.push_back(scene + ": MSE x 100 / BadPix 0.07 / 0.03 %");
  table_.header.emplace_back("ms");
  for (std::vector<std::string>& row : table_.rows)
  {
    const auto result = std::find_if(results.begin(), results.end(),
                                     [&](const Result& candidate) { return candidate.name == row.front(); });
    const bool found = result != results.end();
    row.push_back(found ? accuracyText(result->evaluation) : "");
    row.push_back(found ? fixed(result->timing.median(), 0) : "");
  }
  for (const Result& result : results)
  {
    json_["rows"].push_back({{"scene", scene},
                             {what_, result.name},
                             {"time", toJson(result.timing)},
                             {"accuracy", accuracyJson(result)}});
  }
}

void AccuracyTable::publish(const std::string& name) const
{
  benchmark::publish(settings_, name, table_, json_);
}

}  // namespace light_field_depth::benchmark
