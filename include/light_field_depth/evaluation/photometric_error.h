#ifndef LIGHT_FIELD_DEPTH_EVALUATION_PHOTOMETRIC_ERROR_H
#define LIGHT_FIELD_DEPTH_EVALUATION_PHOTOMETRIC_ERROR_H

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// How well a disparity map explains the views, without any truth: every other view is warped to the
/// reference view by the map and compared with it.
struct PhotometricError
{
  /// Mean absolute difference over all pixels, views and channels, in 8-bit levels. Counts occlusions as
  /// errors.
  double mean = 0.0;
  /// Mean over the pixels of the median over the views: hardly touched by occlusions.
  double mean_of_medians = 0.0;
  /// CV_32FC1, the median over the views of each pixel; NaN where no view sees the pixel inside its frame.
  cv::Mat medians;
};

/// @param disparity CV_32FC1 in the size of the views, pixels per grid step; pixels that are not finite are
/// left out
/// @throw InputError if the size or type of the disparity map does not fit the light field
PhotometricError photometricError(const LightField& light_field, const cv::Mat& disparity, ThreadPool& pool);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_EVALUATION_PHOTOMETRIC_ERROR_H
