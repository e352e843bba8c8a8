#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_KNOWN_AROUND_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_KNOWN_AROUND_H

#include <opencv2/core.hpp>

#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Where the views say nothing, a search ends anywhere in its range, mostly at one of its ends, and a
/// refinement that starts there takes the step to what is known for an edge and keeps it. Brings the pixels
/// of which nothing is known between the farthest and the nearest of what is known around them: in the cells
/// of 32 x 32 pixels about their own, or where nothing is known there, in cells of twice the side, and so on.
/// @param weight CV_32FC1, of the data  @param disparity CV_32FC1
void bringToKnownAround(const cv::Mat& weight, ThreadPool& pool, cv::Mat& disparity);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_KNOWN_AROUND_H
