#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_ABLATION_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_ABLATION_H

#include <vector>

#include "contestant.h"
#include "report_files.h"

namespace light_field_depth::benchmark
{
/// The first is what the others are compared with. A new ingredient joins with one line.
const std::vector<Variant>& ablationVariants();

/// What each ingredient of the multi-view method brings: each off or changed, one at a time, on every input.
void ablate(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_ABLATION_H
