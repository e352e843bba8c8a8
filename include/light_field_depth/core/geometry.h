#ifndef LIGHT_FIELD_DEPTH_CORE_GEOMETRY_H
#define LIGHT_FIELD_DEPTH_CORE_GEOMETRY_H

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// Depth along the optical axis in metres, Z = f * baseline / (d + disparity_offset); NaN where the disparity
/// is not finite or the point would lie at infinity or behind the camera (d + disparity_offset <= 0).
float depthFromDisparity(float disparity_px, const Calibration& calibration);

/// The inverse. @param depth_m > 0
float disparityFromDepth(float depth_m, const Calibration& calibration);

/// CV_32FC1 disparity -> CV_32FC1 depth in metres, NaN where unknown.
cv::Mat depthMap(const cv::Mat& disparity, const Calibration& calibration);

/// The disparities with NaN where the depth is below the one limit or above the other. @param disparity
/// CV_32FC1
/// @param min_depth_m, max_depth_m 0: no limit
/// @return the map itself where there is no limit, else a copy
cv::Mat limitDepth(const cv::Mat& disparity, const Calibration& calibration, float min_depth_m,
                   float max_depth_m);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_GEOMETRY_H
