// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/refine/noise_discount_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/base/pixel_loops-inl.h"
#include "core/multiview/refine/noise_discount_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

void addCappedLoop(const float* curvature, const float* noise, int width, float* curvature_sums,
                   float* noise_sums)
{
  forPixels(0, width,
            [&](auto f, int x)
            {
              const auto cap = hn::LoadU(f, noise + x);
              const auto capped =
                  hn::Min(hn::LoadU(f, curvature + x), hn::Mul(hn::Set(f, CURVATURE_CAP), cap));
              hn::StoreU(hn::Add(hn::LoadU(f, curvature_sums + x), capped), f, curvature_sums + x);
              hn::StoreU(hn::Add(hn::LoadU(f, noise_sums + x), cap), f, noise_sums + x);
            });
}

void discountRowLoop(const DiscountRow& row)
{
  forPixels(0, row.width,
            [&](auto f, int x)
            {
              const auto off = hn::Mul(hn::Set(f, row.margin), hn::LoadU(f, row.noise + x));
              const auto left = hn::Max(hn::Sub(hn::LoadU(f, row.values + x), off), hn::Zero(f));
              const auto limited = hn::Min(left, hn::Set(f, row.most));
              hn::StoreU(hn::Mul(hn::LoadU(f, row.share + x), limited), f, row.values + x);
            });
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(addCappedLoop);
HWY_EXPORT(discountRowLoop);

void addCapped(const float* curvature, const float* noise, int width, float* curvature_sums,
               float* noise_sums)
{
  HWY_DYNAMIC_DISPATCH(addCappedLoop)(curvature, noise, width, curvature_sums, noise_sums);
}

void discountRow(const DiscountRow& row)
{
  HWY_DYNAMIC_DISPATCH(discountRowLoop)(row);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
