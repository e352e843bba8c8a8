#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_ABLATION_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_ABLATION_H

#include "report_files.h"

namespace light_field_depth::benchmark
{
/// What each ingredient of the multi-view method brings: each off or changed, one at a time, on every input.
void ablate(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_ABLATION_H
