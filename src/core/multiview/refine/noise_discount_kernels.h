#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_NOISE_DISCOUNT_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_NOISE_DISCOUNT_KERNELS_H

namespace light_field_depth::multiview
{
/// Loops of the noise's discount (noise_discount.h). Every kernel has a plain version that computes the same
/// values bit for bit.

/// One pixel counts for no more than this many times its noise, so that an edge says nothing about the blank
/// wall beside it.
constexpr float CURVATURE_CAP = 2.0F;

/// curvature_sums += min(curvature, CURVATURE_CAP * noise),  noise_sums += noise
void addCapped(const float* curvature, const float* noise, int width, float* curvature_sums,
               float* noise_sums);
void addCappedPlain(const float* curvature, const float* noise, int width, float* curvature_sums,
                    float* noise_sums);

/// values = share * min(max(values - margin * noise, 0), most)
struct DiscountRow
{
  const float* noise = nullptr;
  const float* share = nullptr;
  float margin = 0.0F;
  float most = 0.0F;
  int width = 0;
  float* values = nullptr;
};

void discountRow(const DiscountRow& row);
void discountRowPlain(const DiscountRow& row);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_NOISE_DISCOUNT_KERNELS_H
