#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_TIMING_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_TIMING_H

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace light_field_depth::benchmark
{
/// Times of the same work, one entry a run.
struct Timing
{
  std::vector<double> milliseconds;                 ///< by the clock on the wall
  std::vector<double> processor_milliseconds = {};  ///< of all threads together; empty where it was not taken

  double median() const;
  double fastest() const;
  double slowest() const;
};

/// Of the values, the mean of the two in the middle where their number is even. @pre not empty
double median(std::vector<double> values);

/// Does every task in every round, so that a machine that changes its speed changes it for all. Before it
/// runs on the clock a task fills the caches by running once, as in a stream of frames; one that takes long
/// does so in the first round only, since it does not find its data in a cache anyway.
/// @return one entry a task
std::vector<Timing> timeInRounds(const std::vector<std::function<void()>>& tasks, int rounds);

/// "183 (153..306)"; with decimals below ten.
std::string toText(const Timing& timing);
/// {"median_ms": 183, "min_ms": ..., "max_ms": ..., "all_ms": [...]}, and "processor_median_ms" where it was
/// taken
nlohmann::json toJson(const Timing& timing);

/// Time that an action takes.
template <class Action>
double millisecondsOf(const Action& action)
{
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_TIMING_H
