#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_EXPOSURE_VIEWS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_EXPOSURE_VIEWS_H

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// What the exposure search makes of reduced views of 8 bits, at least 5 pixels high and wide.

/// Makes mean and contrast of the surroundings alike everywhere.
/// @param grey CV_8UC1
cv::Mat normalizeLocally(const cv::Mat& grey);

/// Smoothed over windows of 5 x 5 pixels, so that small displacements do not matter where brightness is
/// compared.
cv::Mat lowPass(const cv::Mat& image);

/// As many channels as the image has, 0 where nothing next to the pixel is cut off at black or white.
cv::Mat cutOffValues(const cv::Mat& image);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_EXPOSURE_VIEWS_H
