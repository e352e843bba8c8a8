#include <algorithm>

#include "core/multiview/refine/slope_kernels.h"
#include "core/multiview/refine/smoothing_kernels.h"

namespace light_field_depth::multiview
{
void addChangesPlain(const ChangeRow& row)
{
  const float per_weight = 0.5F / row.full_weight;
  const float per_px = 1.0F / row.soft_px;
  for (int x = row.first; x < row.width; ++x)
  {
    const float change = row.here[x] - row.before[x];
    const float scaled = change * per_px;
    const float square = scaled * scaled;
    const float known = std::min((row.weight[x] + row.weight_before[x]) * per_weight, 1.0F);
    const float share = row.guide[x] * known / (1.0F + square * square);
    row.change_sums[x] += share * change;
    row.share_sums[x] += share + row.level_share * row.guide[x];
  }
}

void leanRowPlain(const LeaningRow& row)
{
  for (int x = 0; x < row.width; ++x)
  {
    const float before = row.left[x] * row.slope_left[x] + row.up[x] * row.slope_above[x];
    const float after = row.left[x + 1] * row.slope_left[x + 1] + row.down[x] * row.slope_below[x];
    row.leaning[x] = row.target[x] + (before - after) / (row.weight[x] + TINY_WEIGHT);
  }
}

}  // namespace light_field_depth::multiview
