#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DENSE_FLOW_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DENSE_FLOW_H

#include <optional>
#include <string>

#include <opencv2/core.hpp>

#include "core/paper2017/angular_volume.h"
#include "core/paper2017/patch_match.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/paper2017_options.h"

namespace light_field_depth
{
/// What OpenCV lacks for an initializer, as a whole sentence, or nothing.
std::optional<std::string> whatIsMissingFor(FlowInitializer initializer);

/// A match for every pixel of a view: the optical flow of an OpenCV method to another view, projected on the
/// epipolar line.
/// @param initializer Dis, DeepFlow or PcaFlow  @pre nothing is missing for it
/// @param range that disparities are clamped to
/// Thread safe.
SeedMatches matchByFlow(const View& from, const View& to, FlowInitializer initializer,
                        const std::optional<DisparityRange>& range);

/// A match for every pixel of a view: sparse ones spread to all pixels by the edge-aware interpolation of
/// EpicFlow (Revaud et al., CVPR 2015), as OpenCV has it.
/// @param matches of the view `from`
/// @pre nothing is missing for FlowInitializer::EpicFlow
/// Thread safe.
SeedMatches spreadByEpicFlow(const View& from, const View& to, const SparseDisparity& matches,
                             int grid_spacing_px, const std::optional<DisparityRange>& range);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_DENSE_FLOW_H
