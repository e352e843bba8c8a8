#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DISPARITY_FUSION_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DISPARITY_FUSION_H

#include <vector>

#include <opencv2/core.hpp>

#include "core/paper2017/feature_flow.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// Brings a view's map to the pixel grid of the reference view. Where several pixels land on one, the nearest
/// surface wins; values without confidence do not take part.
/// @return disparity NaN and confidence 0 where nothing lands
/// Thread safe.
DenseDisparity warpToReference(const DenseDisparity& map, const View& view);

/// The opposite: what the reference view's map says about another view.
DenseDisparity warpFromReference(const DenseDisparity& map, const View& view);

/// Several estimates of one map, made one (paper, 3.3.1).
struct FusedDisparity
{
  cv::Mat disparity;   ///< CV_32FC1, median of the estimates; finite
  cv::Mat confidence;  ///< CV_32FC1, 0..1: their support, how many there are and how well they agree
};

/// @param maps of the reference view, NaN where an estimate is missing; at least one, of one size
FusedDisparity fuseByMedian(const std::vector<DenseDisparity>& maps, ThreadPool& pool);

/// Replaces each value that is not finite by the nearest one that is; by 0 when there is none.
void fillFromNearest(cv::Mat& values_32fc1);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DISPARITY_FUSION_H
