#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_VIEW_MAPS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_VIEW_MAPS_H

#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// The disparity map of every view from that of the reference: each pixel is moved to where the view sees it,
/// the nearest in front. Gaps that a slanted surface leaves take the confidence of their neighbours; pixels
/// that the reference view does not see take the disparity of the background beside them and confidence 0.
/// @param disparity, confidence CV_32FC1 of the reference view, finite, in pixels per unit of View::steps
/// @param maps one for each view; memory that they bring is used again unless somebody else holds it
void warpToViews(const LightField& light_field, const cv::Mat& disparity, const cv::Mat& confidence,
                 ThreadPool& pool, std::vector<ViewDisparity>& maps);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_VIEW_MAPS_H
