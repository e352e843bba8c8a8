#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_OPENCV_BASELINES_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_OPENCV_BASELINES_H

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth::benchmark
{
/// What a user of a light field can do with OpenCV alone, for comparison. All return the disparity of the
/// reference view in pixels per grid step (CV_32FC1), NaN where the method has no answer. For views on the
/// reference's row and column.

/// DIS optical flow (medium preset, finest scale 0) from the reference view to every other view of its row
/// and column, per-pixel median. Dense.
cv::Mat disMedian(const LightField& light_field);

/// Semi-global block matching between the two outermost views of the reference row, brought to the reference
/// view.
/// @param range in pixels per grid step
cv::Mat semiGlobalWidestPair(const LightField& light_field, const DisparityRange& range);

/// The same with plain block matching.
cv::Mat blockMatchingWidestPair(const LightField& light_field, const DisparityRange& range);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_OPENCV_BASELINES_H
