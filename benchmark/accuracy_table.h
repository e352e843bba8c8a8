#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_ACCURACY_TABLE_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_ACCURACY_TABLE_H

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "contestant.h"
#include "report_files.h"

namespace light_field_depth::benchmark
{
/// Accuracy and time of several rows side by side on several scenes.
class AccuracyTable
{
public:
  /// @param what the rows are: "variant"
  AccuracyTable(const Settings& settings, std::string what, const std::vector<std::string>& rows);

  /// The results of one more scene. Rows without a result stay empty.
  void add(const std::string& scene, const std::vector<Result>& results);

  /// Prints the table and writes it, see benchmark::publish().
  void publish(const std::string& name) const;

private:
  const Settings& settings_;
  std::string what_;
  Table table_;
  nlohmann::json json_;
};

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_ACCURACY_TABLE_H
