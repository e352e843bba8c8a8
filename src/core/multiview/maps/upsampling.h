#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_UPSAMPLING_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_UPSAMPLING_H

#include <opencv2/core.hpp>

#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Brings a disparity map of half the resolution to the full one. Smooth surfaces are interpolated linearly;
/// at depth edges each pixel takes the side whose pixels have its colour, so that no value lies between two
/// surfaces.
/// @param half_disparity, half_confidence CV_32FC1 of size / 2, rounded down
/// @param edge_jump difference among 3 x 3 disparities above which they are an edge, in their unit
/// @param image CV_8UC1 or CV_8UC3 of the full resolution, which guides
/// @param disparity, confidence CV_32FC1 results in the size of the image; the values keep their unit
void upsample(const cv::Mat& half_disparity, const cv::Mat& half_confidence, float edge_jump,
              const cv::Mat& image, ThreadPool& pool, cv::Mat& disparity, cv::Mat& confidence);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_UPSAMPLING_H
