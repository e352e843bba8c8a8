#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_WARP_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_WARP_H

#include <cstdint>

#include <opencv2/core.hpp>

#include "core/cloud/surface_map.h"
#include "light_field_depth/core/light_field.h"

namespace light_field_depth::cloud
{
/// A map as another view sees it.
struct WarpedSurface
{
  cv::Mat disparity;     ///< CV_32FC1, resampled to the pixel's centre along the surface's plane
  cv::Mat source;        ///< CV_32SC1, index of the map's pixel; NOTHING_HERE where the map shows nothing
  cv::Mat distance;      ///< CV_32FC1, squared, from the pixel's centre to where the map's pixel falls
  cv::Mat row_target;    ///< scratch: CV_32SC1, of a row of the map on its way (ProjectedRow)
  cv::Mat row_there;     ///< CV_32FC1, likewise
  cv::Mat row_distance;  ///< likewise

  static constexpr std::int32_t NOTHING_HERE = -1;
};

/// Brings the pixels of a map that take part to where a view sees them, the nearest surface in front, and of
/// one surface the pixel that falls nearest to the centre. Single gaps inside a surface are closed.
/// @param warped memory that it brings is used again
void warpSurface(const SurfaceMap& map, const View& view, const Tolerance& tolerance, WarpedSurface& warped);

}  // namespace light_field_depth::cloud

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_WARP_H
