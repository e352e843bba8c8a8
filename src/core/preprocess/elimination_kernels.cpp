// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/preprocess/elimination_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstddef>

#include "core/preprocess/elimination_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

void eliminateUnknownSimd(const float* values, float own, int size, int stride, float* matrix)
{
  const hn::CappedTag<float, ELIMINATED_FLOATS> f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  for (int a = 0; a < size; ++a)
  {
    if (values[a] == 0.0F)
    {
      continue;  // of a view that does not see the point
    }
    const auto part = hn::Set(f, values[a] / own);
    float* const row = matrix + static_cast<std::ptrdiff_t>(a) * stride;
    for (int b = a - a % ELIMINATED_FLOATS; b < stride; b += lanes)
    {
      hn::StoreU(hn::Sub(hn::LoadU(f, row + b), hn::Mul(part, hn::LoadU(f, values + b))), f, row + b);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth
{
HWY_EXPORT(eliminateUnknownSimd);

void eliminateUnknown(const float* values, float own, int size, int stride, float* matrix)
{
  HWY_DYNAMIC_DISPATCH(eliminateUnknownSimd)(values, own, size, stride, matrix);
}

}  // namespace light_field_depth
#endif  // HWY_ONCE
