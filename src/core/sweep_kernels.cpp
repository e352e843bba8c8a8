// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sweep_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sweep_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

/// Rows are short, so that what whole vectors leave over counts: it is done in parts before single elements.
template <class Element, std::size_t MOST_LANES>
struct Steps
{
  using Whole = hn::CappedTag<Element, MOST_LANES>;
  using Part = hn::CappedTag<Element, 8>;
  using Single = hn::CappedTag<Element, 1>;
};

/// Runs body(tag, i) as long as whole vectors are left. @return the number of elements done
template <class Tag, class Body>
HWY_INLINE std::size_t forEachVector(Tag tag, std::size_t begin, std::size_t end, const Body& body)
{
  const std::size_t lanes = hn::Lanes(tag);
  for (; begin + lanes <= end; begin += lanes)
  {
    body(tag, begin);
  }
  return begin;
}

template <class AllSteps, class Body>
HWY_INLINE void forEach(std::size_t count, const Body& body)
{
  std::size_t done = forEachVector(typename AllSteps::Whole(), 0, count, body);
  done = forEachVector(typename AllSteps::Part(), done, count, body);
  forEachVector(typename AllSteps::Single(), done, count, body);
}

template <class Body>
HWY_INLINE void forEachByte(std::size_t count, const Body& body)
{
  forEach<Steps<std::uint8_t, 32>>(count, body);
}

template <class Body>
HWY_INLINE void forEachWord(std::size_t count, const Body& body)
{
  forEach<Steps<std::uint16_t, 32>>(count, body);
}

template <class WordTag>
HWY_INLINE hn::Vec<WordTag> loadBytes(WordTag words, const std::uint8_t* from)
{
  return hn::PromoteTo(words, hn::LoadU(hn::Rebind<std::uint8_t, WordTag>(), from));
}

template <class WordTag>
HWY_INLINE hn::Vec<WordTag> multiplyHigh(WordTag words, hn::Vec<WordTag> value, std::uint16_t factor)
{
  return hn::MulHigh(value, hn::Set(words, factor));
}

void blendBytesSimd(const std::uint8_t* a, const std::uint8_t* b, int weight_b, std::size_t count,
                    std::uint8_t* to)
{
  constexpr int SHIFT = 5;
  static_assert(BLEND_WEIGHTS == 1 << SHIFT, "the sum is divided by a shift");
  const auto second = static_cast<std::uint16_t>(weight_b);
  const auto first = static_cast<std::uint16_t>(BLEND_WEIGHTS - weight_b);
  forEachWord(count,
              [=](auto words, std::size_t i) HWY_ATTR
              {
                const hn::RebindToSigned<decltype(words)> demotable;
                const hn::Rebind<std::uint8_t, decltype(words)> bytes;
                const auto weighed = hn::Add(hn::Mul(loadBytes(words, a + i), hn::Set(words, first)),
                                             hn::Mul(loadBytes(words, b + i), hn::Set(words, second)));
                const auto half = hn::Set(words, static_cast<std::uint16_t>(BLEND_WEIGHTS / 2));
                const auto mean = hn::ShiftRight<SHIFT>(hn::Add(weighed, half));
                hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(demotable, mean)), bytes, to + i);
              });
}

void addDifferencesSimd(const std::uint8_t* a, const std::uint8_t* b, std::uint8_t most, std::size_t count,
                        std::uint8_t* sums)
{
  forEachByte(count,
              [=](auto bytes, std::size_t i) HWY_ATTR
              {
                const auto one = hn::LoadU(bytes, a + i);
                const auto other = hn::LoadU(bytes, b + i);
                const auto difference = hn::Sub(hn::Max(one, other), hn::Min(one, other));
                const auto truncated = hn::Min(difference, hn::Set(bytes, most));
                hn::StoreU(hn::Add(hn::LoadU(bytes, sums + i), truncated), bytes, sums + i);
              });
}

void slideColumnsSimd(const std::uint8_t* entering, const std::uint8_t* leaving, std::size_t count,
                      std::uint16_t* columns)
{
  forEachWord(count,
              [=](auto words, std::size_t i) HWY_ATTR
              {
                const auto change = hn::Sub(loadBytes(words, entering + i), loadBytes(words, leaving + i));
                hn::StoreU(hn::Add(hn::LoadU(words, columns + i), change), words, columns + i);
              });
}

void addWindowsSimd(const std::uint16_t* columns, std::uint16_t factor, std::size_t count,
                    std::uint16_t* total, std::uint16_t* worst)
{
  forEachWord(count,
              [=](auto words, std::size_t i) HWY_ATTR
              {
                const auto outer = hn::Add(hn::LoadU(words, columns + i), hn::LoadU(words, columns + i + 4));
                const auto inner =
                    hn::Add(hn::LoadU(words, columns + i + 1), hn::LoadU(words, columns + i + 3));
                const auto window = hn::Add(hn::Add(outer, inner), hn::LoadU(words, columns + i + 2));
                const auto value = multiplyHigh(words, window, factor);
                hn::StoreU(hn::Add(hn::LoadU(words, total + i), value), words, total + i);
                hn::StoreU(hn::Max(hn::LoadU(words, worst + i), value), words, worst + i);
              });
}

void dropWorstSimd(const std::uint16_t* worst, std::uint16_t divisor, std::size_t count, std::uint16_t* total)
{
  // Exact for divisors of 2 and 3 and totals below 32768.
  const auto reciprocal = static_cast<std::uint16_t>(0xFFFF / divisor + 1);
  forEachWord(count,
              [=](auto words, std::size_t i) HWY_ATTR
              {
                const auto rest = hn::Sub(hn::LoadU(words, total + i), hn::LoadU(words, worst + i));
                hn::StoreU(divisor == 1 ? rest : multiplyHigh(words, rest, reciprocal), words, total + i);
              });
}

void keepBestSimd(const std::uint16_t* cost, std::uint16_t label, std::size_t count, std::uint16_t* best_cost,
                  std::uint16_t* best_label)
{
  forEachWord(count,
              [=](auto words, std::size_t i) HWY_ATTR
              {
                const auto value = hn::LoadU(words, cost + i);
                const auto best = hn::LoadU(words, best_cost + i);
                const auto labels = hn::LoadU(words, best_label + i);
                const auto better = hn::Lt(value, best);
                hn::StoreU(hn::Min(value, best), words, best_cost + i);
                hn::StoreU(hn::IfThenElse(better, hn::Set(words, label), labels), words, best_label + i);
              });
}

void keepLeastSimd(const std::uint16_t* cost, std::size_t count, std::uint16_t* least)
{
  forEachWord(count,
              [=](auto words, std::size_t i) HWY_ATTR
              {
                const auto smaller = hn::Min(hn::LoadU(words, cost + i), hn::LoadU(words, least + i));
                hn::StoreU(smaller, words, least + i);
              });
}

void keepRivalSimd(const std::uint16_t* cost, std::uint16_t label, const std::uint16_t* best_label,
                   std::uint16_t distance, std::size_t count, std::uint16_t* least)
{
  forEachWord(count,
              [=](auto words, std::size_t i) HWY_ATTR
              {
                const auto here = hn::Set(words, label);
                const auto best = hn::LoadU(words, best_label + i);
                const auto apart = hn::Sub(hn::Max(here, best), hn::Min(here, best));
                const auto before = hn::LoadU(words, least + i);
                const auto near = hn::Lt(apart, hn::Set(words, distance));
                const auto after = hn::Min(before, hn::LoadU(words, cost + i));
                hn::StoreU(hn::IfThenElse(near, before, after), words, least + i);
              });
}

void exposeBytesSimd(const std::uint8_t* value, const ExposureRow& row, std::size_t count, std::uint8_t* to)
{
  constexpr float WHITE = 255.0F;
  forEach<Steps<float, 16>>(
      count,
      [=](auto floats, std::size_t i) HWY_ATTR
      {
        const hn::Rebind<std::int32_t, decltype(floats)> integers;
        const hn::Rebind<std::uint8_t, decltype(floats)> bytes;
        const auto shading = hn::Mul(hn::Set(floats, row.shading), hn::LoadU(floats, row.gain + i));
        const auto factor = hn::Add(hn::LoadU(floats, row.factor + i), shading);
        const auto seen = hn::ConvertTo(floats, hn::PromoteTo(integers, hn::LoadU(bytes, value + i)));
        const auto exposed = hn::Add(hn::Mul(seen, factor), hn::LoadU(floats, row.offset + i));
        const auto clamped = hn::Min(hn::Max(exposed, hn::Zero(floats)), hn::Set(floats, WHITE));
        hn::StoreU(hn::DemoteTo(bytes, hn::NearestInt(clamped)), bytes, to + i);
      });
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth
{
HWY_EXPORT(blendBytesSimd);
HWY_EXPORT(addDifferencesSimd);
HWY_EXPORT(slideColumnsSimd);
HWY_EXPORT(addWindowsSimd);
HWY_EXPORT(dropWorstSimd);
HWY_EXPORT(keepBestSimd);
HWY_EXPORT(keepLeastSimd);
HWY_EXPORT(keepRivalSimd);
HWY_EXPORT(exposeBytesSimd);

void blendBytes(const std::uint8_t* a, const std::uint8_t* b, int weight_b, std::size_t count,
                std::uint8_t* to)
{
  HWY_DYNAMIC_DISPATCH(blendBytesSimd)(a, b, weight_b, count, to);
}

void addDifferences(const std::uint8_t* a, const std::uint8_t* b, std::uint8_t most, std::size_t count,
                    std::uint8_t* sums)
{
  HWY_DYNAMIC_DISPATCH(addDifferencesSimd)(a, b, most, count, sums);
}

void slideColumns(const std::uint8_t* entering, const std::uint8_t* leaving, std::size_t count,
                  std::uint16_t* columns)
{
  HWY_DYNAMIC_DISPATCH(slideColumnsSimd)(entering, leaving, count, columns);
}

void addWindows(const std::uint16_t* columns, std::uint16_t factor, std::size_t count, std::uint16_t* total,
                std::uint16_t* worst)
{
  HWY_DYNAMIC_DISPATCH(addWindowsSimd)(columns, factor, count, total, worst);
}

void dropWorst(const std::uint16_t* worst, std::uint16_t divisor, std::size_t count, std::uint16_t* total)
{
  HWY_DYNAMIC_DISPATCH(dropWorstSimd)(worst, divisor, count, total);
}

void keepBest(const std::uint16_t* cost, std::uint16_t label, std::size_t count, std::uint16_t* best_cost,
              std::uint16_t* best_label)
{
  HWY_DYNAMIC_DISPATCH(keepBestSimd)(cost, label, count, best_cost, best_label);
}

void keepLeast(const std::uint16_t* cost, std::size_t count, std::uint16_t* least)
{
  HWY_DYNAMIC_DISPATCH(keepLeastSimd)(cost, count, least);
}

void keepRival(const std::uint16_t* cost, std::uint16_t label, const std::uint16_t* best_label,
               std::uint16_t distance, std::size_t count, std::uint16_t* least)
{
  HWY_DYNAMIC_DISPATCH(keepRivalSimd)(cost, label, best_label, distance, count, least);
}

void exposeBytes(const std::uint8_t* value, const ExposureRow& row, std::size_t count, std::uint8_t* to)
{
  HWY_DYNAMIC_DISPATCH(exposeBytesSimd)(value, row, count, to);
}

}  // namespace light_field_depth
#endif  // HWY_ONCE
