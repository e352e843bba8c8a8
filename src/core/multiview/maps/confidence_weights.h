#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_CONFIDENCE_WEIGHTS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_CONFIDENCE_WEIGHTS_H

namespace light_field_depth::multiview
{
/// Weights of the evidence against a disparity, rounded from what scripts/fit_confidence.py fits; the limits
/// keep one piece of evidence from being everything, and are, like what an edge begins with, set by hand
/// before the fit.
constexpr float BASE = -6.9F;
constexpr float EDGE_WEIGHT = 12.0F;      // a jump in 3 x 3 pixels
constexpr float NEAR_EDGE_WEIGHT = 4.0F;  // in 5 x 5 pixels
constexpr float EDGE_FROM_PX = 0.05F;
constexpr float NEAR_EDGE_FROM_PX = 0.1F;
constexpr float EDGE_WIDTH_PX = 0.3F;
constexpr float UNCERTAINTY_WEIGHT = 20.0F;  // of 1 / sqrt(1 + weight of the data in units of LITTLE_DATA)
/// The smoothing carries far, so that a surface is known where its data weigh little; it is not where they
/// weigh next to nothing. Measured with scripts/fit_confidence.py: with 1 instead of 1/64 the area above the
/// ideal order (AUSE, BadPix 0.07) is 0.182 instead of 0.179 on the demo and twice as large on clean renders.
constexpr float LITTLE_DATA = 1.0F / 64.0F;
constexpr float DISAGREEMENT_WEIGHT = 25.0F;
constexpr float DISAGREEMENT_LIMIT_PX = 0.3F;
constexpr float PULL_WEIGHT = 18.0F;  // from the views' minimum to the smooth surface
constexpr float PULL_LIMIT_PX = 0.15F;
constexpr float MOVE_WEIGHT = 27.0F;  // by the refinement
constexpr float MOVE_LIMIT_PX = 0.3F;
constexpr float CHANGE_WEIGHT = 6.4F;  // from the first search to the second
constexpr float CHANGE_LIMIT_PX = 0.3F;
constexpr float RESIDUAL_WEIGHT = 0.1F;
constexpr float RESIDUAL_FREE = 15.0F;      // sum of three channels
constexpr float RESIDUAL_PER_NOISE = 4.0F;  // of a difference of two noisy pixels, three channels

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_CONFIDENCE_WEIGHTS_H
