#include <algorithm>
#include <cmath>

#include "core/multiview/maps/confidence_kernels.h"
#include "core/multiview/maps/confidence_weights.h"

namespace light_field_depth::multiview
{
namespace
{
float ramp(float value, float from, float width)
{
  return std::clamp((value - from) / width, 0.0F, 1.0F);
}

}  // namespace

void weighEvidencePlain(const EvidenceRow& row, float* against)
{
  for (int x = 0; x < row.width; ++x)
  {
    const float pull = std::abs(row.target[x] - row.disparity[x]);
    const float move = std::abs(row.searched[x] - row.disparity[x]);
    const float change = std::abs(row.first_search[x] - row.searched[x]);
    const float unexplained = row.residual[x] - RESIDUAL_FREE - RESIDUAL_PER_NOISE * row.noise_sigma;
    against[x] =
        BASE + EDGE_WEIGHT * ramp(row.high[x] - row.low[x], EDGE_FROM_PX, EDGE_WIDTH_PX) +
        NEAR_EDGE_WEIGHT * ramp(row.wide_high[x] - row.wide_low[x], NEAR_EDGE_FROM_PX, EDGE_WIDTH_PX) +
        UNCERTAINTY_WEIGHT / std::sqrt(row.weight[x] * (1.0F / LITTLE_DATA) + 1.0F) +
        DISAGREEMENT_WEIGHT * std::min(row.disagreement[x], DISAGREEMENT_LIMIT_PX) +
        PULL_WEIGHT * std::min(pull, PULL_LIMIT_PX) + MOVE_WEIGHT * std::min(move, MOVE_LIMIT_PX) +
        CHANGE_WEIGHT * std::min(change, CHANGE_LIMIT_PX) + RESIDUAL_WEIGHT * std::max(0.0F, unexplained);
  }
}

}  // namespace light_field_depth::multiview
