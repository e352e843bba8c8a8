#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_KERNEL_BENCHMARK_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_KERNEL_BENCHMARK_H

#include "report_files.h"

namespace light_field_depth::benchmark
{
/// Every kernel and its plain twin on one thread with Google Benchmark, and what the machine can do at most.
void benchmarkKernels(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_KERNEL_BENCHMARK_H
