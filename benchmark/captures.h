#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_CAPTURES_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_CAPTURES_H

#include "report_files.h"

namespace light_field_depth::benchmark
{
/// Light fields of real cameras, which have no truth: how well the views, warped to the reference view by the
/// disparity, match it.
void measureCaptures(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_CAPTURES_H
