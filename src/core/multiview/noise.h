#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_NOISE_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_NOISE_H

#include "core/multiview/solver.h"

namespace light_field_depth::multiview
{
/// Fits everything that depends on noise: blurs the views when there is some, and raises the truncation, the
/// smoothness and the window of the refinement with what the blur leaves. Strong noise also gets three passes
/// of visibility and one more refinement, except in grey searches.
/// @param noise_sigma from estimateNoise()
void adaptToNoise(float noise_sigma, SolverSettings& settings);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_NOISE_H
