#include <algorithm>

#include "core/multiview/refine/noise_discount_kernels.h"

namespace light_field_depth::multiview
{
void addCappedPlain(const float* curvature, const float* noise, int width, float* curvature_sums,
                    float* noise_sums)
{
  for (int x = 0; x < width; ++x)
  {
    curvature_sums[x] += std::min(curvature[x], CURVATURE_CAP * noise[x]);
    noise_sums[x] += noise[x];
  }
}

void discountRowPlain(const DiscountRow& row)
{
  for (int x = 0; x < row.width; ++x)
  {
    const float left = std::max(row.values[x] - row.margin * row.noise[x], 0.0F);
    row.values[x] = row.share[x] * std::min(left, row.most);
  }
}

}  // namespace light_field_depth::multiview
