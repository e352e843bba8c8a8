#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_BOUNDARY_PIXELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_BOUNDARY_PIXELS_H

#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Which side a pixel at a depth edge belongs to. A pixel that both surfaces share moves with the nearer one
/// in all views, so that matching gives it to the nearer one even where it is a small part of it. Its colour
/// tells how large the part is.
struct BoundaryPixelSettings
{
  float min_contrast = 20.0F;  ///< between the two sides, summed over three channels of 0..255
  /// Of the nearer side's colours and of what the pixel's colour is beside the mixtures of the two, in units
  /// of the contrast. Where noise and the blur against it spread all colours more is worth its errors
  /// (docs/experiments.md).
  float max_relative_spread = 0.3F;
};

/// Gives edge pixels that are mostly background the disparity of the background.
/// @param disparity CV_32FC1, finite  @param image of the reference view
void decideBoundaryPixels(const PlanarImage& image, const BoundaryPixelSettings& settings, ThreadPool& pool,
                          cv::Mat& disparity, cv::Mat& scratch);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_BOUNDARY_PIXELS_H
