#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_SCALING_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_SCALING_H

#include "report_files.h"

namespace light_field_depth::benchmark
{
/// How the time of the default method grows with pixels, views, labels and threads, on a scene that is made
/// for it. Also draws the figures as scaling.png into the folder of results.
void measureGrowth(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_SCALING_H
