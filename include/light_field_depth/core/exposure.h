#ifndef LIGHT_FIELD_DEPTH_CORE_EXPOSURE_H
#define LIGHT_FIELD_DEPTH_CORE_EXPOSURE_H

#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// How the brightness of one view departs from that of the reference view:
///   reference = gain[c] * (1 + shading . (u, v, u^2 + v^2)) * value + offset[c] + bend[c] * value^2 / 255
/// for what both views see of the same scene point. (u, v) is the pixel in this view, relative to the middle
/// of the view in units of half its diagonal.
struct ViewExposure
{
  bool differs = false;        ///< false: cannot be told from the reference; everything else is then neutral
  cv::Vec3d gain{1, 1, 1};     ///< for each channel of the view in its order; grey views use the first
  cv::Vec3d offset{0, 0, 0};   ///< in 8-bit units
  cv::Vec3d bend{0, 0, 0};     ///< another tone curve; in pairs of views only, where a line fits badly
  cv::Vec3d shading{0, 0, 0};  ///< vignetting that differs from the reference's, common to all channels
};

/// Exposure, white balance, black level and vignetting of every view relative to the reference view, from the
/// images alone.
///
/// Scene points are matched in a plane sweep of reduced views whose local mean and contrast have been made
/// alike, which leaves nothing of a difference in exposure; then each view's model is fitted to the
/// brightness of the matched points, without those that are nearly black, nearly white or fit badly. About
/// 2 ms for 17 views of 512 x 512 pixels in colour on two threads.
///
/// @param light_field of 8-bit views; see toEightBit()
/// @param max_displacement_px how far a point may move between the reference view and the view nearest to it;
///   see DisparityRangeOptions
/// @return one entry for each view. A view is left as it is (differs is false) where the change would be less
///   than half a grey level, where the matched points do not clearly ask for it or are too few, and in light
///   fields of less than 32 pixels in height or width. Independent of the number of threads.
/// @throw InputError if the views do not have 8 bits
std::vector<ViewExposure> estimateExposure(const LightField& light_field, ThreadPool& pool,
                                           float max_displacement_px = 48.0F);

/// The light field with the brightness of every view as the reference's. Images of views that do not differ
/// are shared, the others are new.
/// @param exposures one for each view
LightField compensateExposure(const LightField& light_field, const std::vector<ViewExposure>& exposures,
                              ThreadPool& pool);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_EXPOSURE_H
