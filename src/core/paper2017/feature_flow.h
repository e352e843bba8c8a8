#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_FEATURE_FLOW_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_FEATURE_FLOW_H

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/paper2017/domain_transform.h"
#include "core/paper2017/patch_match.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/paper2017_options.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// A dense estimate in the pixel grid of one view.
struct DenseDisparity
{
  cv::Mat disparity;   ///< CV_32FC1, pixels per grid step; finite; 0 everywhere if there is no match at all
  cv::Mat confidence;  ///< CV_32FC1, 0..1, growing with G*(n), the support by matches; 0 where there is none
};

/// Diffuses sparse matches over a volume: G*(n f) / G*(n), with the domain transform G on x, y and, along
/// the disparity paths, the angular axis. The paths of the first iteration follow the matches to the next
/// view, those of later ones the dense estimate; a pixel that no such path reaches is joined to the previous
/// view by its backward match. An occluded path ends.
/// @param views     of the volume, in order
/// @param estimates for each view what is diffused: its match to the next view (the last view: to the
///                  previous one), or several matches combined
/// @param forward   for each view its matches with the next; the last is not read
/// @param backward  for each view its matches with the previous; the first is not read
std::vector<DenseDisparity> featureFlow(const std::vector<const View*>& views,
                                        const std::vector<SparseDisparity>& estimates,
                                        const std::vector<SparseDisparity>& forward,
                                        const std::vector<SparseDisparity>& backward,
                                        const FeatureFlowOptions& options, ThreadPool& pool);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_FEATURE_FLOW_H
