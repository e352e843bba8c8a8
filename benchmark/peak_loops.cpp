// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "peak_loops.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "peak_loops.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::benchmark
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

/// Applies `step` to eight independent chains, so that no operation waits for another.
template <class Tag, class Step>
HWY_INLINE double spin(Tag tag, std::int64_t iterations, double operations_per_step, const Step& step)
{
  constexpr double chains = 8.0;
  auto a = hn::Iota(tag, 0);
  auto b = hn::Iota(tag, 1);
  auto c = hn::Iota(tag, 2);
  auto d = hn::Iota(tag, 3);
  auto e = hn::Iota(tag, 4);
  auto f = hn::Iota(tag, 5);
  auto g = hn::Iota(tag, 6);
  auto h = hn::Iota(tag, 7);
  for (std::int64_t i = 0; i < iterations; ++i)
  {
    a = step(a);
    b = step(b);
    c = step(c);
    d = step(d);
    e = step(e);
    f = step(f);
    g = step(g);
    h = step(h);
  }
  const auto sum = hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, d)), hn::Add(hn::Add(e, f), hn::Add(g, h)));
  HWY_ALIGN hn::TFromD<Tag> lanes[hn::MaxLanes(Tag())];
  hn::Store(sum, tag, lanes);
  volatile auto result = lanes[0];  // the loop must not be taken for superfluous
  static_cast<void>(result);
  return static_cast<double>(iterations) * chains * operations_per_step * static_cast<double>(hn::Lanes(tag));
}

template <class Tag>
double spinIntegers(std::int64_t iterations)
{
  const Tag tag;
  const auto one = hn::Set(tag, 1);
  const auto limit = hn::Set(tag, 100);
  return spin(tag, iterations, 2.0,
              [&](auto value) HWY_ATTR { return hn::Min(hn::SaturatedAdd(value, one), limit); });
}

double spinBytesSimd(std::int64_t iterations)
{
  return spinIntegers<hn::CappedTag<std::uint8_t, 64>>(iterations);
}

double spinWordsSimd(std::int64_t iterations)
{
  return spinIntegers<hn::CappedTag<std::uint16_t, 32>>(iterations);
}

double spinFloatsSimd(std::int64_t iterations)
{
  const hn::CappedTag<float, 16> tag;
  const auto factor = hn::Set(tag, 0.999F);
  const auto term = hn::Set(tag, 0.001F);
  return spin(tag, iterations, 2.0, [&](auto value) HWY_ATTR { return hn::MulAdd(value, factor, term); });
}

const char* targetName()
{
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::benchmark
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::benchmark
{
HWY_EXPORT(spinBytesSimd);
HWY_EXPORT(spinWordsSimd);
HWY_EXPORT(spinFloatsSimd);
HWY_EXPORT(targetName);

double spinBytes(std::int64_t iterations)
{
  return HWY_DYNAMIC_DISPATCH(spinBytesSimd)(iterations);
}

double spinWords(std::int64_t iterations)
{
  return HWY_DYNAMIC_DISPATCH(spinWordsSimd)(iterations);
}

double spinFloats(std::int64_t iterations)
{
  return HWY_DYNAMIC_DISPATCH(spinFloatsSimd)(iterations);
}

std::string vectorInstructions()
{
  return HWY_DYNAMIC_DISPATCH(targetName)();
}

}  // namespace light_field_depth::benchmark
#endif  // HWY_ONCE
