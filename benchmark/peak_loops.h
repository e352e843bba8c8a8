#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_PEAK_LOOPS_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_PEAK_LOOPS_H

#include <cstdint>
#include <string>

namespace light_field_depth::benchmark
{
/// Loops that do nothing but arithmetic on registers, with the widest vectors that the kernels use.
/// @return the number of operations on single lanes that were done
double spinBytes(std::int64_t iterations);
double spinWords(std::int64_t iterations);
double spinFloats(std::int64_t iterations);

/// The name of the instruction set that is chosen at run time: "AVX2", ...
std::string vectorInstructions();

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_PEAK_LOOPS_H
