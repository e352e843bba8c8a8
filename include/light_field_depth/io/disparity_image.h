#ifndef LIGHT_FIELD_DEPTH_IO_DISPARITY_IMAGE_H
#define LIGHT_FIELD_DEPTH_IO_DISPARITY_IMAGE_H

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// The disparities that most of a map lies in: its 0.5th and 99.5th percentile, at least a little apart;
/// 0..1 if nothing is finite.
/// @param disparity CV_32FC1
DisparityRange shownRange(const cv::Mat& disparity);

/// Disparity in colours, from blue (far) to red (near), grey where it is not finite.
/// @param disparity CV_32FC1
/// @return CV_8UC3 (BGR) of the same size
cv::Mat colorizeDisparity(const cv::Mat& disparity, const DisparityRange& range);

/// colorizeDisparity() with a scale at its right: a bar of the colours with the pixels that they stand for.
cv::Mat disparityWithScale(const cv::Mat& disparity, const DisparityRange& range);

/// A quick look at a result: the reference view, disparityWithScale() and the confidence beside each other.
/// @param reference as View::image
/// @param confidence CV_32FC1, 0 (black) to 1 (white)
/// @return CV_8UC3
cv::Mat previewImage(const cv::Mat& reference, const cv::Mat& disparity, const cv::Mat& confidence);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_DISPARITY_IMAGE_H
