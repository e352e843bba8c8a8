#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_CONFIDENCE_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_CONFIDENCE_H

#include <opencv2/core.hpp>

#include "core/multiview/refine/linearizer.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// What is known about the making of a disparity map. All CV_32FC1, of one size.
struct ConfidenceEvidence
{
  const cv::Mat& disparity;            ///< the result
  const cv::Mat& searched;             ///< the map before the refinement
  const cv::Mat& first_search;         ///< the first search's map
  const Linearization& linearization;  ///< of the last refinement
  float noise_sigma = 0.0F;            ///< of the views, in 8-bit units
};

/// Estimates the probability that a disparity is right to 0.07 px (with the outermost view four steps away).
/// Its weights come from a logistic regression on light fields with known truth. It falls
///   - at depth edges, where two surfaces share pixels,
///   - where little texture fixes the disparity,
///   - where horizontally and vertically displaced views disagree,
///   - where the refinement, the smoothness or the second search moved the disparity far,
///   - where even the arm of views that fits best differs from the reference by more than noise.
/// @param confidence CV_32FC1, 0..1
void estimateConfidence(const ConfidenceEvidence& evidence, ThreadPool& pool, cv::Mat& confidence);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_CONFIDENCE_H
