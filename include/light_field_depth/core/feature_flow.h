#ifndef LIGHT_FIELD_DEPTH_CORE_FEATURE_FLOW_H
#define LIGHT_FIELD_DEPTH_CORE_FEATURE_FLOW_H

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/domain_transform.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/patch_match.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// Feature flow (paper, 3.2.2; Lang et al., 2012). The scales are those of the paper where nothing else is
/// said.
struct FeatureFlowOptions
{
  /// false: the paper's ablation. Each pixel takes the nearest match of its view; nothing is filtered.
  bool enabled = true;
  /// sigma_s of the spatial filter in pixels. Lower it to let a match reach less far.
  double sigma_spatial_px = 2000.0;
  /// sigma_r of the spatial filter, of the sum of three colour channels in 0..1. The paper has 0.4, which
  /// lets disparity bleed across every edge of less than about 30 grey levels. Raise it for noisy views.
  double sigma_range = 0.1;
  /// Whether the filter runs along the angular axis as well.
  bool angular = true;
  /// sigma_s of the angular filter in views.
  double sigma_angular_views = 5.0;
  /// sigma_r of the angular filter, of the sum of three colour channels in 0..1.
  double sigma_angular_range = 0.1;
  /// Rounds of filtering x, y and the angular axis.
  int iterations = 3;
};

/// One whole sentence for each field that cannot be used.
std::vector<std::string> validate(const FeatureFlowOptions& options);

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

#endif  // LIGHT_FIELD_DEPTH_CORE_FEATURE_FLOW_H
