// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/search/cost_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <utility>

#include "core/multiview/search/cost_kernels.h"
#include "core/multiview/search/tap_weights.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
#if HWY_TARGET == HWY_SCALAR
// A processor without any of the known vector instructions.
void interpolateTapsSimd(const std::array<const std::uint8_t*, 4>& taps, int phase, int count,
                         std::uint8_t* values)
{
  interpolateTapsPlain(taps, phase, count, values);
}

void armCostRowSimd(const ArmCostRow& row, std::uint8_t* cost)
{
  armCostRowPlain(row, cost);
}

void visibleCostRowSimd(const VisibleCostRow& row, std::uint8_t* cost)
{
  visibleCostRowPlain(row, cost);
}
#else
namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::CappedTag<std::uint8_t, 64>;
using HalfBytes = hn::Half<Bytes>;
using QuarterBytes = hn::Half<HalfBytes>;
using Words = hn::Repartition<std::uint16_t, Bytes>;
using HalfWords = hn::Half<Words>;
using SignedWords = hn::RebindToSigned<Words>;
using Integers = hn::Repartition<std::int32_t, Bytes>;
using Floats = hn::Repartition<float, Bytes>;

#if HWY_ARCH_X86 && HWY_TARGET != HWY_EMU128
// What Highway has no word for: products of bytes, added in pairs, and two vectors of words as one of bytes,
// 128 bits of each in turn.
#if HWY_TARGET <= HWY_AVX3
HWY_INLINE hn::Vec<SignedWords> addedProducts(hn::Vec<Bytes> values, hn::Vec<SignedWords> weights)
{
  return hn::Vec<SignedWords>{_mm512_maddubs_epi16(values.raw, weights.raw)};
}
HWY_INLINE hn::Vec<Bytes> toBytes(hn::Vec<SignedWords> low, hn::Vec<SignedWords> high)
{
  return hn::Vec<Bytes>{_mm512_packus_epi16(low.raw, high.raw)};
}
#elif HWY_TARGET == HWY_AVX2
HWY_INLINE hn::Vec<SignedWords> addedProducts(hn::Vec<Bytes> values, hn::Vec<SignedWords> weights)
{
  return hn::Vec<SignedWords>{_mm256_maddubs_epi16(values.raw, weights.raw)};
}
HWY_INLINE hn::Vec<Bytes> toBytes(hn::Vec<SignedWords> low, hn::Vec<SignedWords> high)
{
  return hn::Vec<Bytes>{_mm256_packus_epi16(low.raw, high.raw)};
}
#else
HWY_INLINE hn::Vec<SignedWords> addedProducts(hn::Vec<Bytes> values, hn::Vec<SignedWords> weights)
{
  return hn::Vec<SignedWords>{_mm_maddubs_epi16(values.raw, weights.raw)};
}
HWY_INLINE hn::Vec<Bytes> toBytes(hn::Vec<SignedWords> low, hn::Vec<SignedWords> high)
{
  return hn::Vec<Bytes>{_mm_packus_epi16(low.raw, high.raw)};
}
#endif

void interpolateTapsSimd(const std::array<const std::uint8_t*, 4>& taps, int phase, int count,
                         std::uint8_t* values)
{
  const Bytes bytes;
  const SignedWords words;
  const auto& weights = TAP_WEIGHTS[static_cast<std::size_t>(phase)];
  // The first one of a pair lies in the lower byte.
  const auto pairOf = [&](int first, int second) HWY_ATTR
  { return hn::Set(words, static_cast<std::int16_t>(second * 256 + (first & 255))); };
  const auto weights01 = pairOf(weights[0], weights[1]);
  const auto weights23 = pairOf(weights[2], weights[3]);
  const auto half = hn::Set(words, TAP_SCALE / 2);
  const int lanes = static_cast<int>(hn::Lanes(bytes));
  for (int x = 0; x < count; x += lanes)
  {
    const auto tap0 = hn::LoadU(bytes, taps[0] + x);
    const auto tap1 = hn::LoadU(bytes, taps[1] + x);
    const auto tap2 = hn::LoadU(bytes, taps[2] + x);
    const auto tap3 = hn::LoadU(bytes, taps[3] + x);
    const auto sum = [&](hn::Vec<Bytes> taps01, hn::Vec<Bytes> taps23) HWY_ATTR
    {
      const auto products = hn::Add(addedProducts(taps01, weights01), addedProducts(taps23, weights23));
      return hn::ShiftRight<TAP_SHIFT>(hn::Add(products, half));
    };
    const auto low = sum(hn::InterleaveLower(bytes, tap0, tap1), hn::InterleaveLower(bytes, tap2, tap3));
    const auto high = sum(hn::InterleaveUpper(bytes, tap0, tap1), hn::InterleaveUpper(bytes, tap2, tap3));
    hn::StoreU(toBytes(low, high), bytes, values + x);
  }
}
#else
void interpolateTapsSimd(const std::array<const std::uint8_t*, 4>& taps, int phase, int count,
                         std::uint8_t* values)
{
  const SignedWords words;
  const hn::Rebind<std::uint8_t, SignedWords> bytes;
  const auto& weights = TAP_WEIGHTS[static_cast<std::size_t>(phase)];
  const auto w0 = hn::Set(words, weights[0]);
  const auto w1 = hn::Set(words, weights[1]);
  const auto w2 = hn::Set(words, weights[2]);
  const auto w3 = hn::Set(words, weights[3]);
  const auto half = hn::Set(words, TAP_SCALE / 2);
  const int lanes = static_cast<int>(hn::Lanes(words));
  for (int x = 0; x < count; x += lanes)
  {
    const auto load = [&](std::size_t tap) HWY_ATTR
    { return hn::PromoteTo(words, hn::LoadU(bytes, taps[tap] + x)); };
    const auto outer = hn::Add(hn::Mul(load(0), w0), hn::Mul(load(3), w3));
    const auto inner = hn::Add(hn::Mul(load(1), w1), hn::Mul(load(2), w2));
    const auto sum = hn::ShiftRight<TAP_SHIFT>(hn::Add(hn::Add(outer, half), inner));
    hn::StoreU(hn::DemoteTo(bytes, sum), bytes, values + x);
  }
}
#endif  // HWY_ARCH_X86 && HWY_TARGET != HWY_EMU128

/// min(truncation, sum over the channels of |reference - sample|).
template <typename Row>
HWY_INLINE hn::Vec<Bytes> truncatedDifference(Bytes bytes, const Row& row, const std::uint8_t* sample, int x,
                                              hn::Vec<Bytes> truncation)
{
  const auto difference = [&](std::size_t channel) HWY_ATTR
  {
    const auto a = hn::LoadU(bytes, row.reference + channel * row.reference_stride + x);
    const auto b = hn::LoadU(bytes, sample + static_cast<std::ptrdiff_t>(channel * row.sample_stride) + x);
    return hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a));
  };
  auto sum = difference(0);
  if (row.channels == 3)
  {
    sum = hn::SaturatedAdd(hn::SaturatedAdd(sum, difference(1)), difference(2));
  }
  return hn::Min(sum, truncation);
}

/// Bytes times scale / 2^8, saturated.
HWY_INLINE hn::Vec<Bytes> scaled(Bytes bytes, hn::Vec<Bytes> values, std::uint16_t scale)
{
  const Words words;
  const HalfBytes half;
  const auto factor = hn::Set(words, scale);
  const auto low = hn::ShiftLeft<8>(hn::PromoteTo(words, hn::LowerHalf(half, values)));
  const auto high = hn::ShiftLeft<8>(hn::PromoteTo(words, hn::UpperHalf(half, values)));
  const SignedWords to_signed;
  const auto narrow = [&](hn::Vec<Words> product) HWY_ATTR
  { return hn::DemoteTo(half, hn::BitCast(to_signed, product)); };
  return hn::Combine(bytes, narrow(hn::MulHigh(high, factor)), narrow(hn::MulHigh(low, factor)));
}

/// Sorts so far that the `best` smallest stand first in order.
HWY_INLINE void sortSmallestFirst(Bytes bytes, std::uint8_t* values, std::size_t count, std::size_t best)
{
  const std::size_t lanes = hn::Lanes(bytes);
  for (std::size_t i = 0; i < best; ++i)
  {
    auto smallest = hn::Load(bytes, values + i * lanes);
    for (std::size_t j = i + 1; j < count; ++j)
    {
      const auto other = hn::Load(bytes, values + j * lanes);
      hn::Store(hn::Max(smallest, other), bytes, values + j * lanes);
      smallest = hn::Min(smallest, other);
    }
    hn::Store(smallest, bytes, values + i * lanes);
  }
}

HWY_INLINE hn::Vec<Bytes> meanOfBest(Bytes bytes, const std::uint8_t* sorted, int best)
{
  const auto lanes = hn::Lanes(bytes);
  const auto value = [&](std::size_t i) HWY_ATTR { return hn::Load(bytes, sorted + i * lanes); };
  if (best == 1)
  {
    return value(0);
  }
  const auto first = hn::AverageRound(value(0), value(1));
  return best == 2 ? first : hn::AverageRound(first, hn::AverageRound(value(2), value(3)));
}

void armCostRowSimd(const ArmCostRow& row, std::uint8_t* cost)
{
  // DIRECTIONS of view_set.cpp.
  constexpr std::size_t max_arms = 8;
  const Bytes bytes;
  HWY_ALIGN std::uint8_t arms[max_arms * VECTOR_OVERRUN];
  const auto truncation = hn::Set(bytes, static_cast<std::uint8_t>(row.truncation));
  const int lanes = static_cast<int>(hn::Lanes(bytes));
  for (int x = 0; x < row.width; x += lanes)
  {
    for (int a = 0; a < row.arm_count; ++a)
    {
      auto sum = hn::Zero(bytes);
      for (int view = row.arms[a].first; view < row.arms[a].last; ++view)
      {
        sum = hn::SaturatedAdd(sum, truncatedDifference(bytes, row, row.samples[view], x, truncation));
      }
      hn::Store(scaled(bytes, sum, row.arm_scales[a]), bytes,
                arms + static_cast<std::size_t>(a) * hn::Lanes(bytes));
    }
    sortSmallestFirst(bytes, arms, static_cast<std::size_t>(row.arm_count),
                      static_cast<std::size_t>(row.best_arms));
    hn::StoreU(meanOfBest(bytes, arms, row.best_arms), bytes, cost + x);
  }
}

/// (sum + penalty of the missing views) / number of views, in the scale of FULL_COST, for a quarter vector.
HWY_INLINE hn::Vec<Integers> meanCost(const VisibleCostRow& row, hn::Vec<Integers> sum,
                                      hn::Vec<Integers> seeing)
{
  const Integers integers;
  const Floats floats;
  const auto minimum = hn::Set(integers, row.min_seeing_views);
  const auto counted = hn::Max(seeing, minimum);
  const auto penalty = hn::Mul(hn::Sub(counted, seeing), hn::Set(integers, row.unseen_penalty));
  const auto scale = hn::Set(floats, static_cast<float>(FULL_COST) / static_cast<float>(row.truncation));
  const auto total = hn::Mul(hn::ConvertTo(floats, hn::Add(sum, penalty)), scale);
  const auto mean = hn::Add(hn::Div(total, hn::ConvertTo(floats, counted)), hn::Set(floats, 0.5F));
  return hn::Min(hn::ConvertTo(integers, mean), hn::Set(integers, FULL_COST));
}

void visibleCostRowSimd(const VisibleCostRow& row, std::uint8_t* cost)
{
  const Bytes bytes;
  const HalfBytes half_bytes;
  const QuarterBytes quarter_bytes;
  const Words words;
  const HalfWords half_words;
  const Integers integers;
  HWY_ALIGN std::uint16_t sums[VECTOR_OVERRUN];
  HWY_ALIGN std::uint8_t counts[VECTOR_OVERRUN];
  const auto truncation = hn::Set(bytes, static_cast<std::uint8_t>(row.truncation));
  const auto hidden_above = hn::Set(bytes, static_cast<std::uint8_t>(row.hidden_above));
  const auto one = hn::Set(bytes, 1);
  const int lanes = static_cast<int>(hn::Lanes(bytes));
  const int half_lanes = lanes / 2;
  const int quarter_lanes = lanes / 4;
  const int views_until_overflow = 255 / row.truncation;
  for (int x = 0; x < row.width; x += lanes)
  {
    auto low = hn::Zero(words);
    auto high = hn::Zero(words);
    auto seeing = hn::Zero(bytes);
    for (int first = 0; first < row.views; first += views_until_overflow)
    {
      auto sum = hn::Zero(bytes);
      for (int view = first; view < row.views && view < first + views_until_overflow; ++view)
      {
        const auto surface = hn::LoadU(bytes, row.surfaces[view] + x);
        const auto hidden = hn::SaturatedSub(surface, hidden_above);  // 0 where the view sees the point
        const auto sees = hn::VecFromMask(bytes, hn::Eq(hidden, hn::Zero(bytes)));
        const auto difference = truncatedDifference(bytes, row, row.samples[view], x, truncation);
        sum = hn::Add(sum, hn::And(difference, sees));
        seeing = hn::Add(seeing, hn::And(one, sees));
      }
      low = hn::Add(low, hn::PromoteTo(words, hn::LowerHalf(half_bytes, sum)));
      high = hn::Add(high, hn::PromoteTo(words, hn::UpperHalf(half_bytes, sum)));
    }
    hn::Store(low, words, sums);
    hn::Store(high, words, sums + half_lanes);
    hn::Store(seeing, bytes, counts);
    for (int quarter = 0; quarter < lanes; quarter += quarter_lanes)
    {
      const auto sum = hn::PromoteTo(integers, hn::LoadU(half_words, sums + quarter));
      const auto count = hn::PromoteTo(integers, hn::LoadU(quarter_bytes, counts + quarter));
      hn::StoreU(hn::DemoteTo(quarter_bytes, meanCost(row, sum, count)), quarter_bytes, cost + x + quarter);
    }
  }
}

#endif  // HWY_TARGET == HWY_SCALAR
}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(interpolateTapsSimd);
HWY_EXPORT(armCostRowSimd);
HWY_EXPORT(visibleCostRowSimd);

void interpolateTaps(const std::array<const std::uint8_t*, 4>& taps, int phase, int count,
                     std::uint8_t* values)
{
  HWY_DYNAMIC_DISPATCH(interpolateTapsSimd)(taps, phase, count, values);
}

void armCostRow(const ArmCostRow& row, std::uint8_t* cost)
{
  HWY_DYNAMIC_DISPATCH(armCostRowSimd)(row, cost);
}

void visibleCostRow(const VisibleCostRow& row, std::uint8_t* cost)
{
  HWY_DYNAMIC_DISPATCH(visibleCostRowSimd)(row, cost);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
