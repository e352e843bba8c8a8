// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/refine/coarse_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/base/pixel_loops-inl.h"
#include "core/multiview/refine/coarse_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

/// @param before, after the values beside the pixels
template <class D>
HWY_INLINE void sumResidualsAt(D f, const SystemRow& row, int x, hn::Vec<D> before, hn::Vec<D> after,
                               bool add, const CellSums& sums)
{
  const auto at = [&](const float* values) { return hn::LoadU(f, values + x); };
  const auto value = at(row.values);
  const auto data = hn::Add(at(row.weight), hn::Set(f, TINY_WEIGHT));
  const auto pull = [&](auto link, auto other) { return hn::Mul(link, hn::Sub(other, value)); };
  const auto own = hn::Add(pull(data, at(row.target)), pull(at(row.left), before));
  const auto along = hn::Add(own, pull(hn::LoadU(f, row.left + x + 1), after));
  const auto residual =
      hn::Add(hn::Add(along, pull(at(row.up), at(row.above))), pull(at(row.down), at(row.below)));
  const auto store = [&](auto term, float* sum)
  { hn::StoreU(add ? hn::Add(hn::LoadU(f, sum + x), term) : term, f, sum + x); };
  store(data, sums.weight);
  store(residual, sums.residual);
  store(at(row.left), sums.left);
}

void sumResidualsSimd(const SystemRow& row, int width, bool add, const CellSums& sums)
{
  const OneFloat one;
  const auto value = [&](int x) { return hn::Set(one, row.values[x]); };
  sumResidualsAt(one, row, 0, value(0), value(width > 1 ? 1 : 0), add, sums);
  if (width > 1)
  {
    sumResidualsAt(one, row, width - 1, value(width - 2), value(width - 1), add, sums);
  }
  forPixels(1, width - 1,
            [&](auto f, int x)
            {
              sumResidualsAt(f, row, x, hn::LoadU(f, row.values + x - 1), hn::LoadU(f, row.values + x + 1),
                             add, sums);
            });
}

void joinCellsSimd(const CellRow& row)
{
  const auto join = [&](auto f, int x, auto weight, auto residual, auto left, auto up)
  {
    const auto half = hn::Set(f, COARSE_LINK);
    hn::StoreU(hn::Sub(weight, hn::Set(f, TINY_WEIGHT)), f, row.weight + x);
    hn::StoreU(hn::Div(residual, weight), f, row.target + x);
    hn::StoreU(hn::Mul(half, left), f, row.left + x);
    hn::StoreU(hn::Mul(half, up), f, row.coarse_up + x);
  };
  const int pairs = row.width / 2;
  forPixels(0, pairs,
            [&](auto f, int x)
            {
              hn::Vec<decltype(f)> even;
              hn::Vec<decltype(f)> odd;
              const auto pair = [&](const float* values)
              {
                hn::LoadInterleaved2(f, values + 2 * x, even, odd);
                return hn::Add(even, odd);
              };
              const auto weight = pair(row.sums.weight);
              const auto residual = pair(row.sums.residual);
              const auto up = pair(row.up);
              hn::LoadInterleaved2(f, row.sums.left + 2 * x, even, odd);
              join(f, x, weight, residual, even, up);
            });
  if (row.width % 2 != 0)
  {
    const OneFloat one;
    const auto at = [&](const float* values) { return hn::Set(one, values[2 * pairs]); };
    join(one, pairs, at(row.sums.weight), at(row.sums.residual), at(row.sums.left), at(row.up));
  }
  row.left[(row.width + 1) / 2] = 0.0F;
}

void spreadRowSimd(const float* coarse, float factor, int width, float* fine)
{
  forPixels(0, width / 2,
            [&](auto f, int x)
            {
              const auto change = hn::Mul(hn::Set(f, factor), hn::LoadU(f, coarse + x));
              hn::Vec<decltype(f)> even;
              hn::Vec<decltype(f)> odd;
              hn::LoadInterleaved2(f, fine + 2 * x, even, odd);
              hn::StoreInterleaved2(hn::Add(even, change), hn::Add(odd, change), f, fine + 2 * x);
            });
  if (width % 2 != 0)
  {
    fine[width - 1] += factor * coarse[width / 2];
  }
}

template <class D>
HWY_INLINE void sumGainsAt(D f, const SystemRow& row, int x, hn::Vec<D> before, float* gain, float* charge)
{
  const auto at = [&](const float* values) { return hn::LoadU(f, values + x); };
  const auto e = at(row.values);
  const auto data = hn::Mul(hn::Add(at(row.weight), hn::Set(f, TINY_WEIGHT)), e);
  const auto bend = [&](auto link, auto change) { return hn::Mul(hn::Mul(link, change), change); };
  const auto links =
      hn::Add(bend(at(row.left), hn::Sub(e, before)), bend(at(row.up), hn::Sub(e, at(row.above))));
  hn::StoreU(hn::Add(at(gain), hn::Mul(data, at(row.target))), f, gain + x);
  const auto charged = hn::Add(hn::Mul(data, e), hn::Mul(hn::Set(f, 1.0F / COARSE_LINK), links));
  hn::StoreU(hn::Add(at(charge), charged), f, charge + x);
}

void sumGainsSimd(const SystemRow& row, int width, float* gain, float* charge)
{
  const OneFloat one;
  sumGainsAt(one, row, 0, hn::Set(one, row.values[0]), gain, charge);
  forPixels(1, width,
            [&](auto f, int x) { sumGainsAt(f, row, x, hn::LoadU(f, row.values + x - 1), gain, charge); });
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(sumResidualsSimd);
HWY_EXPORT(joinCellsSimd);
HWY_EXPORT(spreadRowSimd);
HWY_EXPORT(sumGainsSimd);

void sumResiduals(const SystemRow& row, int width, bool add, const CellSums& sums)
{
  HWY_DYNAMIC_DISPATCH(sumResidualsSimd)(row, width, add, sums);
}

void joinCells(const CellRow& row)
{
  HWY_DYNAMIC_DISPATCH(joinCellsSimd)(row);
}

void spreadRow(const float* coarse, float factor, int width, float* fine)
{
  HWY_DYNAMIC_DISPATCH(spreadRowSimd)(coarse, factor, width, fine);
}

void sumGains(const SystemRow& row, int width, float* gain, float* charge)
{
  HWY_DYNAMIC_DISPATCH(sumGainsSimd)(row, width, gain, charge);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
