#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_MAP_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_MAP_H

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::cloud
{
/// Which disparities count as one surface. Parts are of d + d_inf, so of depth.
struct Tolerance
{
  float offset_px = 0.0F;  ///< d_inf
  float floor_px = 0.0F;   ///< what a disparity may be off anyway

  /// f B / Z of a disparity.
  float absolute(float disparity) const { return disparity + offset_px; }
  /// A difference of so many parts of depth, as disparity.
  float gap(float disparity, float part) const
  {
    const float of_depth = part * (disparity + offset_px);
    return of_depth > floor_px ? of_depth : floor_px;
  }
};

/// @param light_field gives d_inf, where it is calibrated, and the widest baseline
Tolerance toleranceFor(const LightField& light_field, const DisparityRange& range);

/// A map that was solved in a view of its own, and what the fusion has to know of each of its pixels.
struct SurfaceMap
{
  cv::Point2d steps;      ///< of its view
  cv::Point2d offset_px;  ///< likewise
  cv::Mat disparity;      ///< CV_32FC1
  cv::Mat confidence;     ///< CV_32FC1; negative where the pixel takes no part: unknown, filled, or at a rim
  cv::Mat slope_x;        ///< CV_32FC1, of the plane through the pixel's surface about it, per pixel
  cv::Mat slope_y;        ///< likewise
  cv::Mat moving;         ///< CV_32FC1, the disparity again, NaN where the pixel takes no part
  DisparityRange range;   ///< of what takes part; 0..0 if nothing does
  cv::Mat held;           ///< CV_32FC1 or empty: confidence where a plane holds the pixel; 0 elsewhere
};

/// CV_8UC1, 255 where a map (CV_32FC1) has no number.
cv::Mat unknownPixels(const cv::Mat& disparity);

/// Drops what hangs between a foreground and a background, and fits planes.
SurfaceMap makeSurfaceMap(const ViewDisparity& map, const View& view, const Tolerance& tolerance,
                          ThreadPool& pool);

/// The most maps that are fused: as many bits as are looked at in a pixel.
constexpr std::size_t MAX_FUSED_MAPS = 32;

/// The first MAX_FUSED_MAPS of them.
std::vector<SurfaceMap> makeSurfaceMaps(const LightField& light_field, const std::vector<ViewDisparity>& maps,
                                        const Tolerance& tolerance, ThreadPool& pool);

/// Of the first map.
DisparityRange rangeOf(const std::vector<ViewDisparity>& maps);

}  // namespace light_field_depth::cloud

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_MAP_H
