#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_THIN_STRUCTURES_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_THIN_STRUCTURES_H

#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Gives a pixel the median of the neighbours that look like it, where that is nearer than the plain median.
/// A structure that is thinner than the window is outvoted in the plain median; its own pixels are alike.
/// @param searched CV_32FC1, px: the map before the plain median
/// @param disparity CV_32FC1, px: the plain median of `searched` on entry, the result on return
void keepThinStructures(const PlanarImage& guide, const cv::Mat& searched, ThreadPool& pool,
                        cv::Mat& disparity);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_THIN_STRUCTURES_H
