#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_VIEW_NOISE_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_VIEW_NOISE_H

#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Noise of a single view, from differences of views: what two views of a calm block do not share is noise,
/// whatever its spectrum. One image cannot tell noise that is correlated from pixel to pixel (demosaicing,
/// denoising, compression) from texture; two can.
struct ViewNoise
{
  float value_variance = 0.0F;  ///< mean over the channels, squared 8-bit levels
  float slope_variance = 0.0F;  ///< of a derivative along x or y by differences of four pixels, likewise
  /// CV_32FC1 of the size of the views: slope_variance about each pixel, as noise grows with brightness.
  cv::Mat local_slope_variance;
};

/// From the calmest blocks of the reference and up to eight of the nearest views, each shifted by whole
/// pixels to where it differs least.
/// @param light_field CV_8UC1 or CV_8UC3 views
/// @param range in the unit of the light field
/// @return standard deviation in 8-bit levels; 0 where too few blocks can be compared
float estimateNoiseOfViews(const LightField& light_field, const DisparityRange& range, ThreadPool& pool);

/// The same from prepared views at a known disparity, with the noise of slopes.
/// @param disparity CV_32FC1, finite, in the unit of the views
void measureViewNoise(const ViewSet& views, const cv::Mat& disparity, ThreadPool& pool, ViewNoise& noise);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_VIEW_NOISE_H
