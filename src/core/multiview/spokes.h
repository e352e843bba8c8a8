#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SPOKES_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SPOKES_H

#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/multiview/linearize_kernels.h"
#include "light_field_depth/core/multiview/view_set.h"

namespace light_field_depth::multiview
{
/// The views of a set by the rays on which they stand.
struct Spokes
{
  std::vector<SampledView> views;
  std::vector<Spoke> spokes;
  std::vector<cv::Point2f> directions;  ///< of each spoke: steps of a view, divided by its position
  std::vector<Spoke> of_arm;            ///< the range of spokes of each arm
};

/// The result points into `views`.
Spokes findSpokes(const ViewSet& views);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SPOKES_H
