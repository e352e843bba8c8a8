#ifndef LIGHT_FIELD_DEPTH_SRC_IO_LINEAR_IMAGES_H
#define LIGHT_FIELD_DEPTH_SRC_IO_LINEAR_IMAGES_H

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// The value of an image of linear light that becomes white: 1, or what all but the brightest thousandth stay
/// below if that is more.
/// @param image CV_32F; what is not finite does not count
float whiteOf(const cv::Mat& image);

/// Linear light as 16-bit levels by the curve of sRGB (IEC 61966-2-1), so that dark parts keep their levels.
/// @param image CV_32F, grey or BGR; what is not a number becomes black
cv::Mat encodedLinear(const cv::Mat& image, float white);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_LINEAR_IMAGES_H
