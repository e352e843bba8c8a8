#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_FUSION_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_FUSION_H

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/cloud/surface_map.h"
#include "core/cloud/surface_warp.h"
#include "light_field_depth/core/light_field.h"

namespace light_field_depth::cloud
{
/// What the maps agree on in one view.
struct FusedView
{
  cv::Mat disparity;   ///< CV_32FC1; NaN where nothing is kept
  cv::Mat confidence;  ///< CV_32FC1, 0..1
  cv::Mat slope_x;     ///< CV_32FC1, of the surface's plane in the pixel grid of the view
  cv::Mat slope_y;     ///< likewise
  cv::Mat votes;       ///< CV_8UC1, maps that agree
  cv::Mat by_first;    ///< CV_8UC1, 1 where the first map is one of them
};

/// What fusing one view needs besides the maps; one for each thread.
struct FusionScratch
{
  std::vector<WarpedSurface> warped;
};

/// Brings all maps to a view, takes the best supported of their surfaces at each pixel, and drops what too
/// few maps support or what a map sees through. Where nothing is left and a plane holds what a map of this
/// very view has, that is taken.
/// @param maps one to MAX_FUSED_MAPS
/// @param min_confidence 0..1
void fuseView(const std::vector<SurfaceMap>& maps, const View& view, const Tolerance& tolerance,
              float min_confidence, FusionScratch& scratch, FusedView& fused);

}  // namespace light_field_depth::cloud

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_FUSION_H
