// Part of each source that is compiled once for each instruction set, hence no ordinary include guard.
#if defined(LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_LOOPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_LOOPS_INL_H
#undef LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_LOOPS_INL_H
#else
#define LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_LOOPS_INL_H
#endif

#include <hwy/highway.h>

#include "core/base/vector_loops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
using Floats = hwy::HWY_NAMESPACE::CappedTag<float, 16>;
using OneFloat = hwy::HWY_NAMESPACE::CappedTag<float, 1>;

/// Calls body(tag, x) for the pixels first .. last - 1 of a row of floats.
template <class Body>
HWY_INLINE void forPixels(int first, int last, const Body& body)
{
  light_field_depth::HWY_NAMESPACE::forElements<float>(first, last, body);
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#endif  // LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_LOOPS_INL_H
