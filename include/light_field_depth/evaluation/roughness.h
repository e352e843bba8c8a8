#ifndef LIGHT_FIELD_DEPTH_EVALUATION_ROUGHNESS_H
#define LIGHT_FIELD_DEPTH_EVALUATION_ROUGHNESS_H

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// How rough a disparity map is where nothing is to be seen, without any truth: what noise and chance make of
/// paper, walls and sky. What is flat in the image should be smooth in the map; the photometric error cannot
/// tell, since there every disparity explains the views.
///
/// Flat are the calmest 30 % of the pixels, by the mean over 17 x 17 pixels of the difference between
/// the brightness smoothed by Gaussians of 1.5 and of 8 px; 12 px of border are left out. Of them the root
/// mean square of the map minus its Gaussian of 8 px.
/// @param disparity CV_32FC1, pixels per grid step; pixels that are not finite are left out
/// @param image the reference view, 8 or 16 bits, grey or BGR, of the same size
/// @return pixels per grid step; 0 where no pixel is left
/// @throw InputError if sizes differ, the map is not of 32-bit floats, or the image is not larger than its
///   border
double roughness(const cv::Mat& disparity, const cv::Mat& image);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_EVALUATION_ROUGHNESS_H
