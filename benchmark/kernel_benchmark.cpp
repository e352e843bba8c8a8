#include "kernel_benchmark.h"

#include <array>
#include <map>

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include "kernels.h"
#include "machine_limits.h"
#include "timing.h"

namespace light_field_depth::benchmark
{
namespace
{
const char* const PLAIN = "/plain";
const char* const VECTORS = "/vectors";

/// Keeps the nanoseconds of every repetition by the name of the benchmark; of the processor, so that other
/// programs on the machine count less.
class Collector : public ::benchmark::BenchmarkReporter
{
public:
  bool ReportContext(const Context& /*context*/) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override
  {
    for (const Run& run : runs)
    {
      if (run.run_type == Run::RT_Iteration)
      {
        nanoseconds_[run.run_name.function_name].push_back(run.GetAdjustedCPUTime());
      }
    }
  }

  const std::vector<double>& nanoseconds(const std::string& name) const { return nanoseconds_.at(name); }

private:
  std::map<std::string, std::vector<double>> nanoseconds_;
};

void add(const std::string& name, const std::function<void()>& call)
{
  ::benchmark::RegisterBenchmark(name.c_str(),
                                 [call](::benchmark::State& state)
                                 {
                                   for ([[maybe_unused]] const auto iteration : state)
                                   {
                                     call();
                                     ::benchmark::ClobberMemory();
                                   }
                                 });
}

/// Runs all registered benchmarks, mixed, so that a machine that changes its speed changes it for all.
void runAll(int repetitions, Collector& collector)
{
  std::array<std::string, 4> arguments = {"bench", "--benchmark_repetitions=" + std::to_string(repetitions),
                                          "--benchmark_enable_random_interleaving=true",
                                          "--benchmark_min_time=0.02"};
  std::array<char*, arguments.size()> pointers{};
  for (std::size_t i = 0; i < arguments.size(); ++i)
  {
    pointers[i] = arguments[i].data();
  }
  auto count = static_cast<int>(pointers.size());
  ::benchmark::Initialize(&count, pointers.data());
  ::benchmark::RunSpecifiedBenchmarks(&collector);
}

}  // namespace

std::vector<Kernel> kernels()
{
  std::vector<Kernel> all = searchKernels();
  const std::vector<Kernel> more = mapKernels();
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

void benchmarkKernels(const Settings& settings)
{
  const std::vector<Kernel> all = kernels();
  for (const Kernel& kernel : all)
  {
    add(kernel.name + PLAIN, kernel.plain);
    add(kernel.name + VECTORS, kernel.vectors);
  }
  Collector collector;
  runAll(settings.runs, collector);
  const MachineLimits limits = measureMachineLimits(settings.threads);

  Table table;
  table.header = {"kernel", "item", "ns per item", "without vectors", "ratio", "GB/s, one thread"};
  nlohmann::json json = describeMachine(settings);
  json["limits"] = toJson(limits);
  for (const Kernel& kernel : all)
  {
    const double vectors = median(collector.nanoseconds(kernel.name + VECTORS));
    const double plain = median(collector.nanoseconds(kernel.name + PLAIN));
    table.rows.push_back({kernel.name, kernel.item, fixed(vectors / kernel.items, 3),
                          fixed(plain / kernel.items, 3), fixed(plain / vectors, 1),
                          fixed(kernel.bytes / vectors, 1)});
    nlohmann::json row;
    row["kernel"] = kernel.name;
    row["item"] = kernel.item;
    row["items"] = kernel.items;
    row["bytes"] = kernel.bytes;
    row["vectors_ns"] = collector.nanoseconds(kernel.name + VECTORS);
    row["plain_ns"] = collector.nanoseconds(kernel.name + PLAIN);
    json["rows"].push_back(row);
  }
  table.note = toText(limits);
  publish(settings, "kernels", table, json);
}

}  // namespace light_field_depth::benchmark
