// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/preprocess/sweep_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "core/base/vector_loops-inl.h"
#include "core/preprocess/sweep_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::CappedTag<std::uint8_t, SWEEP_ROW_PADDING>;

/// a + (b - a) * weight / SWEEP_FRACTIONS, rounded.
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE hn::Vec<Bytes> blend(hn::Vec<Bytes> a, hn::Vec<Bytes> b, int weight)
{
  const int sum = hn::GetLane(a) * (SWEEP_FRACTIONS - weight) + hn::GetLane(b) * weight;
  return hn::Set(Bytes(), static_cast<std::uint8_t>((sum + SWEEP_FRACTIONS / 2) / SWEEP_FRACTIONS));
}
#else
HWY_INLINE hn::Vec<Bytes> blend(hn::Vec<Bytes> a, hn::Vec<Bytes> b, int weight)
{
  constexpr int SHIFT = 5;  // log2 of SWEEP_FRACTIONS
  static_assert(SWEEP_FRACTIONS == 1 << SHIFT, "the sum is divided by a shift");
  // Even and odd bytes apart, so that nothing crosses lanes.
  const hn::Repartition<std::uint16_t, Bytes> words;
  const auto first = hn::Set(words, static_cast<std::uint16_t>(SWEEP_FRACTIONS - weight));
  const auto second = hn::Set(words, static_cast<std::uint16_t>(weight));
  const auto half = hn::Set(words, static_cast<std::uint16_t>(SWEEP_FRACTIONS / 2));
  const auto low = hn::Set(words, std::uint16_t{0xFF});
  const auto one = hn::BitCast(words, a);
  const auto other = hn::BitCast(words, b);
  const auto even =
      hn::Add(hn::Mul(hn::And(one, low), first), hn::Add(hn::Mul(hn::And(other, low), second), half));
  const auto odd = hn::Add(hn::Mul(hn::ShiftRight<8>(one), first),
                           hn::Add(hn::Mul(hn::ShiftRight<8>(other), second), half));
  // The mean of the odd ones is moved up by 8 - SHIFT bits; what stays below it is cut off.
  const auto upper = hn::AndNot(low, hn::ShiftLeft<8 - SHIFT>(odd));
  return hn::BitCast(Bytes(), hn::Or(hn::ShiftRight<SHIFT>(even), upper));
}
#endif

template <bool BETWEEN_COLUMNS, bool BETWEEN_ROWS>
HWY_INLINE void subtractLikenessOf(const SweptBlock& block, std::uint8_t most,
                                   const ByteRows<std::uint8_t>& sums)
{
  const Bytes bytes;
  const int lanes = static_cast<int>(hn::Lanes(bytes));
  for (int y = 0; y < block.height; ++y)
  {
    const std::uint8_t* const reference = block.reference.row(y);
    const std::uint8_t* const upper = block.view.row(y);
    const std::uint8_t* const lower = block.view.row(BETWEEN_ROWS ? y + 1 : y);
    std::uint8_t* const to = sums.row(y);
    const auto column = [&](int x) HWY_ATTR
    {
      const auto value = hn::LoadU(bytes, upper + x);
      return BETWEEN_ROWS ? blend(value, hn::LoadU(bytes, lower + x), block.fraction_y) : value;
    };
    const auto likeness = [&](int x) HWY_ATTR
    {
      const auto value = BETWEEN_COLUMNS ? blend(column(x), column(x + 1), block.fraction_x) : column(x);
      const auto expected = hn::LoadU(bytes, reference + x);
      const auto difference = hn::Or(hn::SaturatedSub(value, expected), hn::SaturatedSub(expected, value));
      return hn::SaturatedSub(hn::Set(bytes, most), difference);
    };
    int x = 0;
    for (; x + lanes <= block.width; x += lanes)
    {
      hn::StoreU(hn::Sub(hn::LoadU(bytes, to + x), likeness(x)), bytes, to + x);
    }
    if (x < block.width)
    {
      const auto inside = hn::FirstN(bytes, static_cast<std::size_t>(block.width - x));
      const auto less = hn::IfThenElseZero(inside, likeness(x));
      hn::StoreU(hn::Sub(hn::LoadU(bytes, to + x), less), bytes, to + x);
    }
  }
}

void subtractLikenessSimd(const SweptBlock& block, std::uint8_t most, const ByteRows<std::uint8_t>& sums)
{
  if (block.fraction_x != 0 && block.fraction_y != 0)
  {
    subtractLikenessOf<true, true>(block, most, sums);
  }
  else if (block.fraction_x != 0)
  {
    subtractLikenessOf<true, false>(block, most, sums);
  }
  else if (block.fraction_y != 0)
  {
    subtractLikenessOf<false, true>(block, most, sums);
  }
  else
  {
    subtractLikenessOf<false, false>(block, most, sums);
  }
}

using Words = hn::CappedTag<std::uint16_t, SWEEP_ROW_PADDING / 2>;

HWY_INLINE hn::Vec<Words> loadBytes(const std::uint8_t* from)
{
  return hn::PromoteTo(Words(), hn::LoadU(hn::Rebind<std::uint8_t, Words>(), from));
}

/// The sums of the columns of the first window.
HWY_INLINE void startColumns(const ByteRows<const std::uint8_t>& sums, int count, int last_row,
                             std::uint16_t* columns)
{
  const Words words;
  for (int x = 0; x < count; x += static_cast<int>(hn::Lanes(words)))
  {
    auto sum = hn::Zero(words);
    for (int y = -SWEEP_WINDOW_RADIUS; y <= SWEEP_WINDOW_RADIUS; ++y)
    {
      sum = hn::Add(sum, loadBytes(sums.row(std::clamp(y, 0, last_row)) + x));
    }
    hn::StoreU(sum, words, columns + x);
  }
}

HWY_INLINE void slideColumns(const std::uint8_t* entering, const std::uint8_t* leaving, int count,
                             std::uint16_t* columns)
{
  const Words words;
  for (int x = 0; x < count; x += static_cast<int>(hn::Lanes(words)))
  {
    const auto change = hn::Sub(loadBytes(entering + x), loadBytes(leaving + x));
    hn::StoreU(hn::Add(hn::LoadU(words, columns + x), change), words, columns + x);
  }
}

template <class WordTag>
HWY_INLINE hn::Vec<WordTag> windowOf(WordTag words, const std::uint16_t* columns, std::uint16_t factor)
{
  static_assert(SWEEP_WINDOW_RADIUS == 2, "five columns are added");
  const auto outer = hn::Add(hn::LoadU(words, columns), hn::LoadU(words, columns + 4));
  const auto inner = hn::Add(hn::LoadU(words, columns + 1), hn::LoadU(words, columns + 3));
  const auto window = hn::Add(hn::Add(outer, inner), hn::LoadU(words, columns + 2));
  return hn::MulHigh(window, hn::Set(words, factor));
}

/// One row of costs.
template <std::size_t ARMS>
HWY_INLINE void meanOfRow(const ArmSums* arms, const std::uint16_t* columns, std::size_t stride,
                          std::size_t width, std::uint16_t* cost)
{
  // Exact for divisors of 2 and 3 and totals below 32768.
  constexpr auto RECIPROCAL = static_cast<std::uint16_t>(ARMS > 2 ? 0xFFFF / (ARMS - 1) + 1 : 0);
  forElements<std::uint16_t>(
      0, static_cast<int>(width),
      [=](auto words, int x) HWY_ATTR
      {
        auto total = windowOf(words, columns + x, arms[0].factor);
        auto worst = total;
        for (std::size_t arm = 1; arm < ARMS; ++arm)
        {
          const auto value = windowOf(words, columns + arm * stride + x, arms[arm].factor);
          total = hn::Add(total, value);
          worst = hn::Max(worst, value);
        }
        const auto rest = ARMS > 1 ? hn::Sub(total, worst) : total;
        const auto mean = ARMS > 2 ? hn::MulHigh(rest, hn::Set(words, RECIPROCAL)) : rest;
        hn::StoreU(mean, words, cost + x);
      });
}

template <std::size_t ARMS>
HWY_INLINE void meanOfWindowsOf(const ArmSums* arms, int width, int height, std::uint16_t* columns,
                                std::uint16_t* cost)
{
  const std::size_t stride = columnsOfWindows(width);
  const int count = width + 2 * SWEEP_WINDOW_RADIUS;
  const int last = height - 1;
  for (int y = 0; y < height; ++y)
  {
    for (std::size_t arm = 0; arm < ARMS; ++arm)
    {
      const ByteRows<const std::uint8_t>& sums = arms[arm].sums;
      if (y == 0)
      {
        startColumns(sums, count, last, columns + arm * stride);
        continue;
      }
      slideColumns(sums.row(std::min(y + SWEEP_WINDOW_RADIUS, last)),
                   sums.row(std::max(y - SWEEP_WINDOW_RADIUS - 1, 0)), count, columns + arm * stride);
    }
    meanOfRow<ARMS>(arms, columns, stride, static_cast<std::size_t>(width),
                    cost + static_cast<std::ptrdiff_t>(y) * width);
  }
}

void meanOfWindowsSimd(const ArmSums* arms, std::size_t count_of_arms, int width, int height,
                       std::uint16_t* columns, std::uint16_t* cost)
{
  switch (count_of_arms)
  {
    case 1:
      return meanOfWindowsOf<1>(arms, width, height, columns, cost);
    case 2:
      return meanOfWindowsOf<2>(arms, width, height, columns, cost);
    case 3:
      return meanOfWindowsOf<3>(arms, width, height, columns, cost);
    default:
      return meanOfWindowsOf<4>(arms, width, height, columns, cost);
  }
}

void keepBestSimd(const std::uint16_t* cost, std::uint16_t label, std::size_t count, std::uint16_t* best_cost,
                  std::uint16_t* best_label)
{
  forElements<std::uint16_t>(0, static_cast<int>(count),
                             [=](auto words, int i) HWY_ATTR
                             {
                               const auto value = hn::LoadU(words, cost + i);
                               const auto best = hn::LoadU(words, best_cost + i);
                               const auto labels = hn::LoadU(words, best_label + i);
                               const auto better = hn::Lt(value, best);
                               hn::StoreU(hn::Min(value, best), words, best_cost + i);
                               hn::StoreU(hn::IfThenElse(better, hn::Set(words, label), labels), words,
                                          best_label + i);
                             });
}

void keepRivalSimd(const std::uint16_t* cost, std::uint16_t label, const std::uint16_t* best_label,
                   std::uint16_t distance, std::size_t count, std::uint16_t* least)
{
  forElements<std::uint16_t>(0, static_cast<int>(count),
                             [=](auto words, int i) HWY_ATTR
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
  /// The largest byte.
  constexpr float WHITE = 255.0F;
  forElements<float>(
      0, static_cast<int>(count),
      [=](auto floats, int i) HWY_ATTR
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
HWY_EXPORT(subtractLikenessSimd);
HWY_EXPORT(meanOfWindowsSimd);
HWY_EXPORT(keepBestSimd);
HWY_EXPORT(keepRivalSimd);
HWY_EXPORT(exposeBytesSimd);

void subtractLikeness(const SweptBlock& block, std::uint8_t most, const ByteRows<std::uint8_t>& sums)
{
  HWY_DYNAMIC_DISPATCH(subtractLikenessSimd)(block, most, sums);
}

void meanOfWindows(const ArmSums* arms, std::size_t count_of_arms, int width, int height,
                   std::uint16_t* columns, std::uint16_t* cost)
{
  HWY_DYNAMIC_DISPATCH(meanOfWindowsSimd)(arms, count_of_arms, width, height, columns, cost);
}

std::size_t columnsOfWindows(int width)
{
  return static_cast<std::size_t>(width) + 2 * SWEEP_WINDOW_RADIUS + SWEEP_ROW_PADDING;
}

void keepBest(const std::uint16_t* cost, std::uint16_t label, std::size_t count, std::uint16_t* best_cost,
              std::uint16_t* best_label)
{
  HWY_DYNAMIC_DISPATCH(keepBestSimd)(cost, label, count, best_cost, best_label);
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
