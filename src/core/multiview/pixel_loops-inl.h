// Part of each source that is compiled once for each instruction set, hence no ordinary include guard.
#if defined(LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_LOOPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_LOOPS_INL_H
#undef LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_LOOPS_INL_H
#else
#define LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_LOOPS_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
using Floats = hwy::HWY_NAMESPACE::CappedTag<float, 16>;
using OneFloat = hwy::HWY_NAMESPACE::CappedTag<float, 1>;

/// Calls body(tag, x) for the pixels first .. last - 1, vector by vector and the rest one by one, so that
/// nothing beyond them is touched.
template <class Body>
HWY_INLINE void forPixels(int first, int last, const Body& body)
{
  const Floats floats;
  const int lanes = static_cast<int>(hwy::HWY_NAMESPACE::Lanes(floats));
  int x = first;
  for (; x + lanes <= last; x += lanes)
  {
    body(floats, x);
  }
  for (; x < last; ++x)
  {
    body(OneFloat(), x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#endif  // LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_LOOPS_INL_H
