#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_SWEEP_VIEWS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_SWEEP_VIEWS_H

#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// Views in one of the four directions of the axes from the reference, nearest first, at most three.
using AxisArm = std::vector<const View*>;

/// Of the camera from that of the reference, in grid steps.
double distanceOf(const View& view);

/// Right, left, below, above, those that have views. Views on the row and the column of the reference come
/// first; where there is none of these, all others are sorted into the direction that they are nearest to.
/// @return pointers into the light field
std::vector<AxisArm> axisArmsOf(const LightField& light_field);

/// Of the view that is nearest to (farthest from) the reference.
double nearestDistance(const std::vector<AxisArm>& arms);
double farthestDistance(const std::vector<AxisArm>& arms);

/// The disparity at which points move by max_displacement_px from the reference to the view nearest to it,
/// but in no direction by more than two fifths of the side of the nearest view there.
float largestDisparity(const std::vector<AxisArm>& arms, float max_displacement_px);

/// The disparity at which points move by this fraction of the side, in no direction by more.
float disparityOfFraction(const std::vector<AxisArm>& arms, double fraction_of_side);

/// Views beyond this distance, in grid steps, take no part in a sweep of the range: half a pixel of theirs
/// for each label would make more labels than can be kept in memory, and most of the range lies outside of
/// their images.
/// @param pixels_per_label spacing of the labels in pixels of the light field
double largestDistance(const DisparityRange& range, double pixels_per_label);

/// How often a view is halved before its longer side would be less than side_px.
int halvingsFor(const cv::Size& size, int side_px);

/// Half the size so many times, each pixel the mean of four. 8 bits, one or three channels. An odd row or
/// column at the end is left out.
/// @return the image itself, sharing its pixels, for 0 times
cv::Mat halve(const cv::Mat& image, int times);

/// Side of the Gaussian kernel that a noisy grey image needs before single pixels are compared; 1 for none.
int blurFor(const cv::Mat& image);

/// @return the image itself, sharing its pixels, for a kernel of 1
cv::Mat blurred(const cv::Mat& image, int kernel_side);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_SWEEP_VIEWS_H
