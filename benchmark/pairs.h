#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_PAIRS_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_PAIRS_H

#include "report_files.h"

namespace light_field_depth::benchmark
{
/// Pairs of views, rendered and given, beside OpenCV's semi-global block matching, which is told the true
/// range: share of the pixels with truth that are off by more than 1 and 4 px, and time.
void comparePairs(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_PAIRS_H
