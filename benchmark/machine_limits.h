#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_MACHINE_LIMITS_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_MACHINE_LIMITS_H

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace light_field_depth::benchmark
{
/// What this machine can do at most with a number of threads, measured.
struct MachineLimits
{
  std::string vector_instructions;  ///< the set that the kernels choose at run time
  double memory_copy_gb_s = 0.0;    ///< bytes read plus bytes written, arrays that no cache holds
  double memory_triad_gb_s = 0.0;   ///< a[i] = b[i] + s * c[i], three arrays
  double cache_triad_gb_s = 0.0;    ///< the same with arrays that the cache shared by the cores holds
  double byte_gops = 0.0;           ///< 10^9 operations a second on 8-bit lanes, in registers
  double word_gops = 0.0;           ///< on 16-bit lanes
  double float_gops = 0.0;          ///< on single precision; a multiply-add counts as two
};

/// Medians of some runs; takes a second or two.
MachineLimits measureMachineLimits(int threads);

/// "memory 20 GB/s (copy), ..." in one sentence.
std::string toText(const MachineLimits& limits);
nlohmann::json toJson(const MachineLimits& limits);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_MACHINE_LIMITS_H
