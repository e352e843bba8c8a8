#ifndef LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_NOISE_H
#define LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_NOISE_H

#include <opencv2/core.hpp>

#include "light_field_depth/core/multiview/solver.h"

namespace light_field_depth::multiview
{
/// Standard deviation of the noise in an 8-bit image, from the response of a second-difference mask in the
/// smoothest of its blocks. Texture leaves about 0.6 in a clean photograph.
/// @param image CV_8UC1 or CV_8UC3
float measureNoise(const cv::Mat& image);

/// Fits everything that depends on noise: blurs the views when there is some, and raises the truncation, the
/// smoothness and the window of the refinement with what the blur leaves.
void adaptToNoise(float noise_sigma, SolverSettings& settings);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_NOISE_H
