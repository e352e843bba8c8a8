#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_VIEW_RAYS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_VIEW_RAYS_H

#include <vector>

#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "core/multiview/refine/linearize_kernels.h"

namespace light_field_depth::multiview
{
/// The views of a set by the rays on which they stand.
struct ViewRays
{
  std::vector<SampledView> views;
  std::vector<ViewRay> rays;
  std::vector<cv::Point2f> directions;  ///< of each ray: steps of a view, divided by its position
  std::vector<ViewRay> of_arm;          ///< the range of rays of each arm
};

/// The result points into `views`.
ViewRays findViewRays(const ViewSet& views);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_VIEW_RAYS_H
