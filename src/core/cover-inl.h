// Included once for each instruction set by the sources of inner loops.
#if defined(LIGHT_FIELD_DEPTH_SRC_CORE_COVER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHT_FIELD_DEPTH_SRC_CORE_COVER_INL_H
#undef LIGHT_FIELD_DEPTH_SRC_CORE_COVER_INL_H
#else
#define LIGHT_FIELD_DEPTH_SRC_CORE_COVER_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace light_field_depth
{
namespace HWY_NAMESPACE
{
/// Runs body(tag, i) for vectors of at most 64 bytes that cover [0, count). The last one may cover again what
/// was covered, so that nothing may be both read and written.
template <class Element, class Body>
HWY_INLINE void cover(int count, const Body& body)
{
  const hwy::HWY_NAMESPACE::CappedTag<Element, 64 / sizeof(Element)> whole;
  const int lanes = static_cast<int>(hwy::HWY_NAMESPACE::Lanes(whole));
  if (count < lanes)
  {
    for (int i = 0; i < count; ++i)
    {
      body(hwy::HWY_NAMESPACE::CappedTag<Element, 1>(), i);
    }
    return;
  }
  for (int i = 0; i < count - lanes; i += lanes)
  {
    body(whole, i);
  }
  body(whole, count - lanes);
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth
HWY_AFTER_NAMESPACE();

#endif
