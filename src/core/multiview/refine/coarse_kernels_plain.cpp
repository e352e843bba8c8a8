#include "core/multiview/refine/coarse_kernels.h"

namespace light_field_depth::multiview
{
void sumResidualsPlain(const SystemRow& row, int width, bool add, const CellSums& sums)
{
  for (int x = 0; x < width; ++x)
  {
    const float value = row.values[x];
    const float data = row.weight[x] + TINY_WEIGHT;
    const float before = x > 0 ? row.values[x - 1] : value;
    const float after = x + 1 < width ? row.values[x + 1] : value;
    const float along =
        data * (row.target[x] - value) + row.left[x] * (before - value) + row.left[x + 1] * (after - value);
    const float residual = along + row.up[x] * (row.above[x] - value) + row.down[x] * (row.below[x] - value);
    sums.weight[x] = add ? sums.weight[x] + data : data;
    sums.residual[x] = add ? sums.residual[x] + residual : residual;
    sums.left[x] = add ? sums.left[x] + row.left[x] : row.left[x];
  }
}

void joinCellsPlain(const CellRow& row)
{
  const int coarse_width = (row.width + 1) / 2;
  for (int x = 0; x < coarse_width; ++x)
  {
    const int i = 2 * x;
    const bool whole = i + 1 < row.width;
    const auto pair = [&](const float* values) { return whole ? values[i] + values[i + 1] : values[i]; };
    const float weight = pair(row.sums.weight);
    row.weight[x] = weight - TINY_WEIGHT;
    row.target[x] = pair(row.sums.residual) / weight;
    row.left[x] = COARSE_LINK * row.sums.left[i];
    row.coarse_up[x] = COARSE_LINK * pair(row.up);
  }
  row.left[coarse_width] = 0.0F;
}

void spreadRowPlain(const float* coarse, float factor, int width, float* fine)
{
  for (int x = 0; x < width; ++x)
  {
    fine[x] += factor * coarse[x / 2];
  }
}

void sumGainsPlain(const SystemRow& row, int width, float* gain, float* charge)
{
  for (int x = 0; x < width; ++x)
  {
    const float e = row.values[x];
    const float data = (row.weight[x] + TINY_WEIGHT) * e;
    const float along = x > 0 ? e - row.values[x - 1] : 0.0F;
    const float down = e - row.above[x];
    const float links = row.left[x] * along * along + row.up[x] * down * down;
    gain[x] += data * row.target[x];
    charge[x] += data * e + (1.0F / COARSE_LINK) * links;
  }
}

}  // namespace light_field_depth::multiview
