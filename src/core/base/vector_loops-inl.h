// Included once for each instruction set by the sources of inner loops, hence no ordinary include guard.
#if defined(LIGHT_FIELD_DEPTH_SRC_CORE_VECTOR_LOOPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHT_FIELD_DEPTH_SRC_CORE_VECTOR_LOOPS_INL_H
#undef LIGHT_FIELD_DEPTH_SRC_CORE_VECTOR_LOOPS_INL_H
#else
#define LIGHT_FIELD_DEPTH_SRC_CORE_VECTOR_LOOPS_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace light_field_depth
{
namespace HWY_NAMESPACE
{
/// Runs body(tag, i) as long as whole vectors are left. @return the first element that is not done
template <class Tag, class Body>
HWY_INLINE int forVectors(Tag tag, int first, int last, const Body& body)
{
  const int lanes = static_cast<int>(hwy::HWY_NAMESPACE::Lanes(tag));
  for (; first + lanes <= last; first += lanes)
  {
    body(tag, first);
  }
  return first;
}

/// Runs body(tag, i) for the elements first .. last - 1, each once and nothing beyond them: vectors of at
/// most 64 bytes, then shorter ones, since rows are short and what is left over counts, then one by one.
template <class Element, class Body>
HWY_INLINE void forElements(int first, int last, const Body& body)
{
  constexpr std::size_t bytes = 64;
  constexpr std::size_t part = 8;
  int done = forVectors(hwy::HWY_NAMESPACE::CappedTag<Element, bytes / sizeof(Element)>(), first, last, body);
  done = forVectors(hwy::HWY_NAMESPACE::CappedTag<Element, part>(), done, last, body);
  forVectors(hwy::HWY_NAMESPACE::CappedTag<Element, 1>(), done, last, body);
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth
HWY_AFTER_NAMESPACE();

#endif
