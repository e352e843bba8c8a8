#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_MEMORY_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_MEMORY_H

#include "report_files.h"

namespace light_field_depth::benchmark
{
/// The most memory that the process holds while the default method works, the light field included. Linux
/// only: elsewhere the figures are 0.
void measureMemory(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_MEMORY_H
