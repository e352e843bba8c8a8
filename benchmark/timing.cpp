#include "timing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>

#include <nlohmann/json.hpp>

namespace light_field_depth::benchmark
{
namespace
{
constexpr double LONG_MS = 500.0;

/// Nobody reads nanoseconds of a frame.
double rounded(double milliseconds)
{
  constexpr double per_millisecond = 1000.0;
  return std::round(milliseconds * per_millisecond) / per_millisecond;
}

}  // namespace

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double Timing::median() const
{
  return benchmark::median(milliseconds);
}

double Timing::fastest() const
{
  return *std::min_element(milliseconds.begin(), milliseconds.end());
}

double Timing::slowest() const
{
  return *std::max_element(milliseconds.begin(), milliseconds.end());
}

std::vector<Timing> timeInRounds(const std::vector<std::function<void()>>& tasks, int rounds)
{
  std::vector<Timing> timings(tasks.size());
  for (int round = 0; round < rounds; ++round)
  {
    for (std::size_t i = 0; i < tasks.size(); ++i)
    {
      if (round == 0 || timings[i].milliseconds.back() < LONG_MS)
      {
        tasks[i]();
      }
      const std::clock_t before = std::clock();
      timings[i].milliseconds.push_back(millisecondsOf(tasks[i]));
      timings[i].processor_milliseconds.push_back(1000.0 * static_cast<double>(std::clock() - before) /
                                                  static_cast<double>(CLOCKS_PER_SEC));
    }
  }
  return timings;
}

std::string toText(const Timing& timing)
{
  constexpr double few_milliseconds = 10.0;
  std::array<char, 64> text{};
  const int decimals = timing.median() < few_milliseconds ? 1 : 0;
  std::snprintf(text.data(), text.size(), "%.*f (%.*f..%.*f)", decimals, timing.median(), decimals,
                timing.fastest(), decimals, timing.slowest());
  return text.data();
}

nlohmann::json toJson(const Timing& timing)
{
  nlohmann::json json;
  json["median_ms"] = rounded(timing.median());
  json["min_ms"] = rounded(timing.fastest());
  json["max_ms"] = rounded(timing.slowest());
  if (!timing.processor_milliseconds.empty())
  {
    json["processor_median_ms"] = rounded(median(timing.processor_milliseconds));
  }
  for (const double milliseconds : timing.milliseconds)
  {
    json["all_ms"].push_back(rounded(milliseconds));
  }
  return json;
}

}  // namespace light_field_depth::benchmark
