// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/refine/slope_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/base/pixel_loops-inl.h"
#include "core/multiview/refine/slope_kernels.h"
#include "core/multiview/refine/smoothing_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

void addChangesSimd(const ChangeRow& row)
{
  forPixels(row.first, row.width,
            [&](auto f, int x)
            {
              const auto one = hn::Set(f, 1.0F);
              const auto guide = hn::LoadU(f, row.guide + x);
              const auto change = hn::Sub(hn::LoadU(f, row.here + x), hn::LoadU(f, row.before + x));
              const auto scaled = hn::Mul(change, hn::Set(f, 1.0F / row.soft_px));
              const auto square = hn::Mul(scaled, scaled);
              const auto weights = hn::Add(hn::LoadU(f, row.weight + x), hn::LoadU(f, row.weight_before + x));
              const auto known = hn::Min(hn::Mul(weights, hn::Set(f, 0.5F / row.full_weight)), one);
              const auto share = hn::Div(hn::Mul(guide, known), hn::Add(one, hn::Mul(square, square)));
              const auto level = hn::Mul(hn::Set(f, row.level_share), guide);
              const auto add = [&](auto value, float* sums)
              { hn::StoreU(hn::Add(hn::LoadU(f, sums + x), value), f, sums + x); };
              add(hn::Mul(share, change), row.change_sums);
              add(hn::Add(share, level), row.share_sums);
            });
}

void leanRowSimd(const LeaningRow& row)
{
  forPixels(0, row.width,
            [&](auto f, int x)
            {
              const auto product = [&](const float* link, const float* slope)
              { return hn::Mul(hn::LoadU(f, link + x), hn::LoadU(f, slope + x)); };
              const auto before =
                  hn::Add(product(row.left, row.slope_left), product(row.up, row.slope_above));
              const auto after =
                  hn::Add(product(row.left + 1, row.slope_left + 1), product(row.down, row.slope_below));
              const auto data = hn::Add(hn::LoadU(f, row.weight + x), hn::Set(f, TINY_WEIGHT));
              const auto lean = hn::Div(hn::Sub(before, after), data);
              hn::StoreU(hn::Add(hn::LoadU(f, row.target + x), lean), f, row.leaning + x);
            });
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(addChangesSimd);
HWY_EXPORT(leanRowSimd);

void addChanges(const ChangeRow& row)
{
  HWY_DYNAMIC_DISPATCH(addChangesSimd)(row);
}

void leanRow(const LeaningRow& row)
{
  HWY_DYNAMIC_DISPATCH(leanRowSimd)(row);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
