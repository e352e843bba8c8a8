#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_REPORT_FILES_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_REPORT_FILES_H

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace light_field_depth::benchmark
{
/// What every measurement is asked for.
struct Settings
{
  std::vector<std::string> inputs;  ///< folders with a light field and its true disparity
  /// Folders with light fields without truth, each as FOLDER or FOLDER,FLIP.
  std::vector<std::string> captures;
  std::vector<std::string> pairs;  ///< each as LEFT,RIGHT,TRUTH[,LEVELS]
  std::string results;             ///< folder for the files; empty: no files
  int runs = 9;                    ///< timed runs of each row
  int threads = 2;
};

/// A table, and what is to be said below it.
struct Table
{
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::string note;
};

std::string toMarkdown(const Table& table);

/// A number with so many decimals.
std::string fixed(double value, int decimals);

/// The machine and the settings, which every report begins with.
nlohmann::json describeMachine(const Settings& settings);

/// Prints a table, and writes it as NAME.md into the folder of results, if there is one.
/// @throw InputError that names the file which cannot be written
void publishTable(const Settings& settings, const std::string& name, const Table& table);

/// Prints a table, and writes it as NAME.md and the report as NAME.json into the folder of results, if there
/// is one.
/// @throw InputError that names the file which cannot be written
void publish(const Settings& settings, const std::string& name, const Table& table,
             const nlohmann::json& report);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_REPORT_FILES_H
