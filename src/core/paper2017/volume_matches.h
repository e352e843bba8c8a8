#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_VOLUME_MATCHES_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_VOLUME_MATCHES_H

#include <optional>
#include <vector>

#include "core/paper2017/angular_volume.h"
#include "core/paper2017/paper2017_estimator.h"
#include "core/paper2017/patch_match.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/run_context.h"

namespace light_field_depth
{
/// The checked matches of one volume, one element a view.
struct VolumeMatches
{
  std::vector<SparseDisparity> forward;   ///< with the next view; empty matrices for the last view
  std::vector<SparseDisparity> backward;  ///< with the previous view; empty matrices for the first view
};

/// Matches all consecutive pairs of all volumes in both directions. Descriptors are computed once a view,
/// however many volumes it is in.
/// @param light_field 8-bit views
std::vector<VolumeMatches> matchVolumes(const LightField& light_field,
                                        const std::vector<AngularVolume>& volumes,
                                        const std::optional<DisparityRange>& range,
                                        const Paper2017Options& options, RunContext& context);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_VOLUME_MATCHES_H
