#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_VIEW_MASK_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_VIEW_MASK_H

#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// The light field with images that repeat, where they are masked, the nearest known pixel of their row, or
/// of the nearest row that has any: the border of a mask is no edge of the scene. The masks stay; images
/// without a masked pixel are shared.
LightField withFilledMasks(const LightField& light_field, ThreadPool& pool);

/// The mask of an image of half the width and height: known is what four known pixels make. Empty for an
/// empty mask.
cv::Mat halvedMask(const cv::Mat& mask);

/// CV_8UC1, 255 where a pixel within `radius_px` of a pixel, in x and in y, is masked; 0 elsewhere.
cv::Mat maskedWithin(const cv::Mat& mask, int radius_px);

/// Makes the maps NaN, with a confidence of 0, where their views are masked.
void invalidateMasked(const LightField& light_field, DisparityEstimate& estimate);
void invalidateMasked(const LightField& light_field, std::vector<ViewDisparity>& maps);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_VIEW_MASK_H
