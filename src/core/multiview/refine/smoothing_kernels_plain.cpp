#include <cmath>
#include <cstdlib>

#include "core/multiview/refine/smoothing_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
float robustLink(float guide, float change, float flat)
{
  return guide * (flat / std::sqrt(change * change + flat * flat));
}

/// What is known of one unknown besides the neighbours along the line that is solved.
struct Unknown
{
  float diagonal;
  float side;
};

/// The unknown to the right (below) is x = value + factor * that one.
struct Elimination
{
  float factor = 0.0F;
  float value = 0.0F;
};

Elimination eliminate(const Unknown& unknown, float link_before, float link_after, const Elimination& before)
{
  const float inverse = 1.0F / (unknown.diagonal - link_before * before.factor);
  return {link_after * inverse, (unknown.side + link_before * before.value) * inverse};
}

Unknown unknownOfRow(const SystemRow& row, int x)
{
  const float data = row.weight[x] + TINY_WEIGHT;
  return {data + row.left[x] + row.left[x + 1] + row.up[x] + row.down[x],
          data * row.target[x] + row.up[x] * row.above[x] + row.down[x] * row.below[x]};
}

}  // namespace

void linkRowPlain(const LinkRow& row)
{
  row.left[0] = 0.0F;
  row.left[row.width] = 0.0F;
  for (int x = 1; x < row.width; ++x)
  {
    row.left[x] = robustLink(row.guide_left[x], row.disparity[x] - row.disparity[x - 1] - row.slope_left[x],
                             row.flat_px);
  }
  for (int x = 0; x < row.width; ++x)
  {
    row.up[x] =
        robustLink(row.guide_above[x], row.disparity[x] - row.above[x] - row.slope_above[x], row.flat_px);
  }
}

void solveRowsPlain(const SystemRow* rows, int count, int width, float* scratch)
{
  auto* const eliminations = reinterpret_cast<Elimination*>(scratch);
  for (int r = 0; r < count; ++r)
  {
    const SystemRow& row = rows[r];
    Elimination before;
    for (int x = 0; x < width; ++x)
    {
      before = eliminate(unknownOfRow(row, x), row.left[x], row.left[x + 1], before);
      eliminations[x] = before;
    }
    float next = 0.0F;
    for (int x = width - 1; x >= 0; --x)
    {
      next = eliminations[x].value + eliminations[x].factor * next;
      row.values[x] = next;
    }
  }
}

void eliminateColumnsPlain(const ColumnStep& step)
{
  for (int x = step.first; x < step.last; ++x)
  {
    const int i = x - step.first;
    const float data = step.weight[x] + TINY_WEIGHT;
    const float left_value = x > 0 ? step.disparity[x - 1] : 0.0F;
    const float right_value = x + 1 < step.width ? step.disparity[x + 1] : 0.0F;
    const Unknown unknown = {
        data + step.left[x] + step.left[x + 1] + step.up[x] + step.down[x],
        data * step.target[x] + step.left[x] * left_value + step.left[x + 1] * right_value};
    const Elimination here =
        eliminate(unknown, step.up[x], step.down[x], {step.factor_above[i], step.value_above[i]});
    step.factor[i] = here.factor;
    step.value[i] = here.value;
  }
}

void substituteColumnsPlain(const float* value, const float* factor, const float* below, int count,
                            float* solution)
{
  for (int i = 0; i < count; ++i)
  {
    solution[i] = value[i] + factor[i] * below[i];
  }
}

}  // namespace light_field_depth::multiview
