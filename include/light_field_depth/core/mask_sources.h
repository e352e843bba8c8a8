#ifndef LIGHT_FIELD_DEPTH_CORE_MASK_SOURCES_H
#define LIGHT_FIELD_DEPTH_CORE_MASK_SOURCES_H

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// The mask (View::mask) of an image that is black where it shows nothing: what a rectification could not
/// fill, the corners beyond a lens. Masked are the black pixels that other black pixels join with the border
/// of the image, and those beside them, whose values are mixed with black; a dark object inside the image is
/// not. Thread safe.
/// @param image CV_8UC1, CV_8UC3, CV_16UC1 or CV_16UC3; black is at most 4 of 255 in every channel, which
/// leaves
///   room for JPEG, and 0 in images of 16 bits
/// @return CV_8UC1, 0 where masked, 255 elsewhere; empty if nothing is
cv::Mat blackMask(const cv::Mat& image);

/// The mask of an image with an alpha channel: 0 where alpha is 0, 255 elsewhere.
/// @param image of 8 or 16 bits; empty is returned unless it has four channels
/// @return CV_8UC1; empty if alpha is 0 nowhere, or everywhere, as those write it who do not use it
cv::Mat alphaMask(const cv::Mat& image);

/// What both masks leave; an empty one leaves everything. Shares the memory of one where the other is empty.
/// @param a CV_8UC1 or empty; 0 where masked
/// @param b likewise, in the same size
cv::Mat bothKnown(const cv::Mat& a, const cv::Mat& b);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_MASK_SOURCES_H
