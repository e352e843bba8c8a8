#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_CONDITIONS_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_CONDITIONS_H

#include "report_files.h"

namespace light_field_depth::benchmark
{
/// The default method under other conditions than those of the data sets: with noise, with fewer views, in
/// grey, with exposure that differs from view to view.
void measureConditions(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_CONDITIONS_H
