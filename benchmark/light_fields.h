#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_LIGHT_FIELDS_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_LIGHT_FIELDS_H

#include "report_files.h"

namespace light_field_depth::benchmark
{
/// Time and accuracy of whole light fields: the presets, the 2017 method, and what OpenCV offers, in one run.
void compareMethods(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_LIGHT_FIELDS_H
