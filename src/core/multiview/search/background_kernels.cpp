// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/search/background_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "core/base/pixel_loops-inl.h"
#include "core/multiview/search/background_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;
using Words = hn::CappedTag<std::int16_t, TILE_PX>;
using Bytes = hn::CappedTag<std::uint8_t, TILE_PX>;

void findLabelCostsSimd(const LabelCosts& costs)
{
  const LabelBand& band = costs.line.band;
  HWY_ALIGN std::int32_t index[TILE_PX];
  HWY_ALIGN float parts[TILE_PX];
  HWY_ALIGN std::int32_t lower[TILE_PX];
  HWY_ALIGN std::int32_t upper[TILE_PX];
  // The label above the last one never counts: its part is 0.
  const int last_below = band.count > 1 ? band.end() - 2 : band.first;
  forPixels(0, costs.count,
            [&](auto f, int x)
            {
              const hn::RebindToSigned<decltype(f)> i;
              const auto label = hn::LoadU(f, costs.label + x);
              const auto first = hn::Set(f, static_cast<float>(band.first));
              const auto inside =
                  hn::Min(hn::Max(label, first), hn::Set(f, static_cast<float>(band.end() - 1)));
              const auto below = hn::Min(hn::ConvertTo(i, inside), hn::Set(i, last_below));
              hn::StoreU(below, i, index + x);
              hn::StoreU(hn::Sub(inside, hn::ConvertTo(f, below)), f, parts + x);
              hn::StoreU(hn::NearestInt(label), i, lower + x);
            });
  const std::ptrdiff_t next = band.count > 1 ? TILE_PX : 0;
  for (int x = 0; x < costs.count; ++x)
  {
    costs.rounded[x] = static_cast<std::int16_t>(lower[x]);
  }
  for (int x = 0; x < costs.count; ++x)
  {
    const std::uint8_t* const cost = costs.line.at(index[x]) + x;
    lower[x] = cost[0];
    upper[x] = cost[next];
  }
  forPixels(0, costs.count,
            [&](auto f, int x)
            {
              const hn::RebindToSigned<decltype(f)> i;
              const auto part = hn::LoadU(f, parts + x);
              const auto rest = hn::Sub(hn::Set(f, 1.0F), part);
              const auto low = hn::ConvertTo(f, hn::LoadU(i, lower + x));
              const auto high = hn::ConvertTo(f, hn::LoadU(i, upper + x));
              hn::StoreU(hn::Add(hn::Mul(low, rest), hn::Mul(high, part)), f, costs.cost + x);
            });
}

bool isComparable(const SupportLine::Lines& lines, int label, int distance)
{
  return lines[0].comparable(label, distance) && lines[2].comparable(label, distance);
}

/// Of three pixels above each other.
HWY_INLINE std::int16_t sumOfColumn(const SupportLine::Lines& lines, int label, int distance, int x)
{
  int sum = 0;
  for (const TileLine& line : lines)
  {
    sum += line.at(label - distance)[x] + line.at(label + distance)[x] - 2 * line.at(label)[x];
  }
  return static_cast<std::int16_t>(sum);
}

/// What makes every sum too small.
constexpr std::int16_t NOT_COMPARABLE = -20000;

/// Sums over three pixels above each other, from one left of the tile to one right of it; those two only
/// where the tile's own pixel beside them asks for the label.
HWY_INLINE void sumColumns(const SupportLine& support, int label, const std::int16_t* labels,
                           std::int16_t* sums)
{
  const Words words;
  const hn::Rebind<std::uint8_t, Words> bytes;
  const int distance = support.distance;
  for (std::size_t x = 0; x < TILE_PX; x += hn::Lanes(words))
  {
    auto sum = hn::Zero(words);
    for (const TileLine& line : support.here)
    {
      const auto cost = [&](int of) { return hn::PromoteTo(words, hn::LoadU(bytes, line.at(of) + x)); };
      const auto own = cost(label);
      sum = hn::Add(sum, hn::Sub(hn::Add(cost(label - distance), cost(label + distance)), hn::Add(own, own)));
    }
    hn::StoreU(sum, words, sums + 1 + x);
  }
  sums[0] = labels[0] == label && isComparable(support.left, label, distance)
                ? sumOfColumn(support.left, label, distance, TILE_PX - 1)
                : NOT_COMPARABLE;
  sums[TILE_PX + 1] = labels[TILE_PX - 1] == label && isComparable(support.right, label, distance)
                          ? sumOfColumn(support.right, label, distance, 0)
                          : NOT_COMPARABLE;
}

/// Takes the pixels with one label out of the labels, and counts those that are supported.
HWY_INLINE int takeLabel(const SupportLine& support, std::int16_t label, std::int16_t* labels)
{
  const Words words;
  const auto none = hn::Set(words, NO_LABEL);
  const auto same = hn::Set(words, label);
  const auto threshold = hn::Set(words, static_cast<std::int16_t>(support.threshold));
  HWY_ALIGN std::int16_t sums[TILE_PX + 2];
  const bool comparable = isComparable(support.here, label, support.distance);
  if (comparable)
  {
    sumColumns(support, label, labels, sums);
  }
  std::size_t count = 0;
  for (std::size_t x = 0; x < TILE_PX; x += hn::Lanes(words))
  {
    const auto own = hn::LoadU(words, labels + x);
    const auto taken = hn::Eq(own, same);
    hn::StoreU(hn::IfThenElse(taken, none, own), words, labels + x);
    if (comparable)
    {
      const auto beside = hn::Add(hn::LoadU(words, sums + x), hn::LoadU(words, sums + x + 2));
      const auto sum = hn::Add(beside, hn::LoadU(words, sums + x + 1));
      count += hn::CountTrue(words, hn::And(hn::Gt(sum, threshold), taken));
    }
  }
  return static_cast<int>(count);
}

/// Few labels share a row of a tile: all of its pixels are looked at once for each.
void countSupportedSimd(const SupportLine& support, std::int16_t* labels, int* counts)
{
  for (std::size_t x = 0; x < TILE_PX; ++x)
  {
    const std::int16_t label = labels[x];
    const int count = label == NO_LABEL ? 0 : takeLabel(support, label, labels);
    if (count > 0)
    {
      counts[label] += count;
    }
  }
}

void addChargesSimd(const std::uint8_t* charge, int labels, std::uint8_t* costs)
{
  const Bytes bytes;
  for (int label = 0; label < labels; ++label)
  {
    const auto added = hn::Set(bytes, charge[label]);
    for (std::size_t i = 0; i < TILE_PX; i += hn::Lanes(bytes))
    {
      hn::StoreU(hn::SaturatedAdd(hn::LoadU(bytes, costs + i), added), bytes, costs + i);
    }
    costs += TILE_PX;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(findLabelCostsSimd);
HWY_EXPORT(countSupportedSimd);
HWY_EXPORT(addChargesSimd);

void findLabelCosts(const LabelCosts& costs)
{
  HWY_DYNAMIC_DISPATCH(findLabelCostsSimd)(costs);
}

void countSupported(const SupportLine& line, std::int16_t* labels, int* counts)
{
  HWY_DYNAMIC_DISPATCH(countSupportedSimd)(line, labels, counts);
}

void addCharges(const std::uint8_t* charge, int labels, std::uint8_t* costs)
{
  HWY_DYNAMIC_DISPATCH(addChargesSimd)(charge, labels, costs);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
