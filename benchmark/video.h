#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_VIDEO_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_VIDEO_H

#include "report_files.h"

namespace light_field_depth::benchmark
{
/// Presets on a moving light field with exact truth, frame by frame and with the last frame's help, and what
/// becomes of them when the scene is cut.
void measureVideo(const Settings& settings);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_VIDEO_H
