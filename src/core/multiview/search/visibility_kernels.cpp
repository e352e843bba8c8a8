// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/search/visibility_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/multiview/search/visibility_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
#if HWY_TARGET == HWY_SCALAR
// A processor without any of the known vector instructions.
void warpTargetsSimd(const WarpRow& row, std::int32_t* targets)
{
  warpTargetsPlain(row, targets);
}
#else
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Integers = hn::RebindToSigned<Floats>;

/// Whether 0 <= value < limit.
HWY_INLINE hn::Mask<Integers> isInside(hn::Vec<Integers> value, int limit)
{
  const Integers integers;
  return hn::And(hn::Gt(value, hn::Set(integers, -1)), hn::Lt(value, hn::Set(integers, limit)));
}

void warpTargetsSimd(const WarpRow& row, std::int32_t* targets)
{
  const Floats floats;
  const Integers integers;
  const int lanes = static_cast<int>(hn::Lanes(floats));
  const auto base_y = hn::Set(floats, row.base_y);
  const auto step_x = hn::Set(floats, row.step_x);
  const auto step_y = hn::Set(floats, row.step_y);
  const auto base_x = hn::Set(floats, row.base_x);
  int x = 0;
  for (; x + lanes <= row.width; x += lanes)
  {
    const auto disparity = hn::LoadU(floats, row.disparity + x);
    const auto column = hn::Add(hn::Iota(floats, static_cast<float>(x)), base_x);
    const auto seen_x = hn::Sub(column, hn::Mul(disparity, step_x));
    const auto seen_y = hn::Sub(base_y, hn::Mul(disparity, step_y));
    const auto target_x = hn::ConvertTo(integers, hn::Floor(seen_x));
    const auto target_y = hn::ConvertTo(integers, hn::Floor(seen_y));
    const auto inside = hn::And(isInside(target_x, row.width), isInside(target_y, row.height));
    const auto target = hn::Add(hn::Add(hn::Mul(target_y, hn::Set(integers, row.pitch)), target_x),
                                hn::Set(integers, row.first));
    hn::StoreU(hn::IfThenElseZero(inside, target), integers, targets + x);
  }
  for (; x < row.width; ++x)
  {
    targets[x] = warpTarget(row, x);
  }
}

#endif  // HWY_TARGET == HWY_SCALAR
}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(warpTargetsSimd);

void warpTargets(const WarpRow& row, std::int32_t* targets)
{
  HWY_DYNAMIC_DISPATCH(warpTargetsSimd)(row, targets);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
