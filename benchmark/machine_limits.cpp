#include "machine_limits.h"

#include <cstddef>
#include <cstring>
#include <vector>

#include <nlohmann/json.hpp>

#include "light_field_depth/core/thread_pool.h"
#include "peak_loops.h"
#include "report_files.h"
#include "timing.h"

namespace light_field_depth::benchmark
{
namespace
{
constexpr int RUNS = 9;
constexpr std::size_t MEMORY_FLOATS = 32U << 20U;  // 128 MiB an array: beyond any cache
constexpr std::size_t CACHE_FLOATS = 1U << 20U;    // 4 MiB an array: beyond the cache of one core
constexpr int CHUNK_FLOATS = 1 << 17;
constexpr double PER_GIGA_AND_MS = 1e-6;

/// Median of amount / time over some runs, in 10^9 a second. @param run returns the amount
template <class Run>
double rate(const Run& run)
{
  std::vector<double> rates;
  for (int i = 0; i <= RUNS; ++i)
  {
    double amount = 0.0;
    const double milliseconds = millisecondsOf([&] { amount = run(); });
    if (i > 0)  // the first one touches the memory
    {
      rates.push_back(amount / milliseconds * PER_GIGA_AND_MS);
    }
  }
  return median(rates);
}

class Arrays
{
public:
  Arrays(std::size_t count, ThreadPool& pool) : a_(count), b_(count, 1.0F), c_(count, 2.0F), pool_(pool) {}

  double copy()
  {
    forChunks([&](std::size_t first, std::size_t count)
              { std::memcpy(&a_[first], &b_[first], count * sizeof(float)); });
    return 2.0 * bytes();
  }

  double triad()
  {
    forChunks(
        [&](std::size_t first, std::size_t count)
        {
          for (std::size_t i = first; i < first + count; ++i)
          {
            a_[i] = b_[i] + 3.0F * c_[i];
          }
        });
    return 3.0 * bytes();
  }

private:
  double bytes() const { return static_cast<double>(a_.size() * sizeof(float)); }

  template <class Body>
  void forChunks(const Body& body)
  {
    pool_.parallelFor(0, static_cast<int>(a_.size()), CHUNK_FLOATS,
                      [&](int first, int last)
                      { body(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first)); });
  }

  std::vector<float> a_;
  std::vector<float> b_;
  std::vector<float> c_;
  ThreadPool& pool_;
};

/// The same loop on every thread.
template <class Spin>
double spinRate(const Spin& spin, ThreadPool& pool)
{
  constexpr std::int64_t iterations = 2'000'000;
  return rate(
      [&]
      {
        std::vector<double> operations(static_cast<std::size_t>(pool.threads()));
        pool.parallelFor(0, pool.threads(), 1,
                         [&](int first, int /*last*/)
                         { operations[static_cast<std::size_t>(first)] = spin(iterations); });
        double sum = 0.0;
        for (const double one : operations)
        {
          sum += one;
        }
        return sum;
      });
}

}  // namespace

MachineLimits measureMachineLimits(int threads)
{
  ThreadPool pool(threads);
  MachineLimits limits;
  limits.vector_instructions = vectorInstructions();
  {
    Arrays arrays(MEMORY_FLOATS, pool);
    limits.memory_copy_gb_s = rate([&] { return arrays.copy(); });
    limits.memory_triad_gb_s = rate([&] { return arrays.triad(); });
  }
  Arrays arrays(CACHE_FLOATS, pool);
  limits.cache_triad_gb_s = rate(
      [&]
      {
        constexpr int repetitions = 20;
        double bytes = 0.0;
        for (int i = 0; i < repetitions; ++i)
        {
          bytes += arrays.triad();
        }
        return bytes;
      });
  limits.byte_gops = spinRate(spinBytes, pool);
  limits.word_gops = spinRate(spinWords, pool);
  limits.float_gops = spinRate(spinFloats, pool);
  return limits;
}

std::string toText(const MachineLimits& limits)
{
  return "Memory: copy " + fixed(limits.memory_copy_gb_s, 1) + " GB/s, triad " +
         fixed(limits.memory_triad_gb_s, 1) + " GB/s; triad in the shared cache " +
         fixed(limits.cache_triad_gb_s, 1) + " GB/s. Arithmetic (" + limits.vector_instructions +
         "): " + fixed(limits.byte_gops, 0) + " x 10^9 operations a second on bytes, " +
         fixed(limits.word_gops, 0) + " on 16-bit words, " + fixed(limits.float_gops, 0) + " on floats.";
}

nlohmann::json toJson(const MachineLimits& limits)
{
  nlohmann::json json;
  json["vector_instructions"] = limits.vector_instructions;
  json["memory_copy_gb_s"] = limits.memory_copy_gb_s;
  json["memory_triad_gb_s"] = limits.memory_triad_gb_s;
  json["cache_triad_gb_s"] = limits.cache_triad_gb_s;
  json["byte_gops"] = limits.byte_gops;
  json["word_gops"] = limits.word_gops;
  json["float_gops"] = limits.float_gops;
  return json;
}

}  // namespace light_field_depth::benchmark
