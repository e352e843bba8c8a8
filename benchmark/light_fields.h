#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_LIGHT_FIELDS_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_LIGHT_FIELDS_H

#include <vector>

#include "contestant.h"
#include "report_files.h"

namespace light_field_depth::benchmark
{
/// The presets and methods of this package. A new one joins with one line.
const std::vector<Variant>& ownMethods();

/// Time and accuracy of the presets alone, for comparing two builds in turns (scripts/bench_against.py).
void measurePresets(const Settings& settings);

/// Time and accuracy of whole light fields: the presets, the 2017 method, and what OpenCV offers, in one run.
void compareMethods(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_LIGHT_FIELDS_H
