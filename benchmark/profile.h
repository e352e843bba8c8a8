#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_PROFILE_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_PROFILE_H

#include "report_files.h"

namespace light_field_depth::benchmark
{
/// Where the time of a frame of the default method goes, stage by stage, on the last input: time, bytes moved
/// and operations, and their shares of what the machine can do.
void profileFrame(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_PROFILE_H
