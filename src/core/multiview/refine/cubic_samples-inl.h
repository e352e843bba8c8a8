// Included once for each instruction set by the sources of inner loops: sub-pixel samples of views.
#if defined(LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_CUBIC_SAMPLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_CUBIC_SAMPLES_INL_H
#undef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_CUBIC_SAMPLES_INL_H
#else
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_CUBIC_SAMPLES_INL_H
#endif

#include <algorithm>
#include <cmath>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "core/multiview/refine/cubic_taps.h"
#include "core/multiview/refine/linearize_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
#if HWY_TARGET != HWY_SCALAR
namespace hn = hwy::HWY_NAMESPACE;

// Samples are taken in words, a block of lanes at a time; what is summed over views is summed in two vectors
// of floats for each vector of words.
using Words = hn::CappedTag<std::int16_t, 32>;
using HalfWords = hn::Half<Words>;
using UnsignedWords = hn::RebindToUnsigned<Words>;
using HalfUnsigned = hn::Half<UnsignedWords>;
using Bytes = hn::Rebind<std::uint8_t, Words>;
using Integers = hn::Repartition<std::int32_t, Words>;
using Floats = hn::Repartition<float, Words>;
using WordVector = hn::Vec<Words>;
using FloatVector = hn::Vec<Floats>;

struct FloatPair
{
  FloatVector low, high;
};

/// Up to three channels, in units of 1 / SAMPLE_UNIT.
struct Samples
{
  WordVector c0, c1, c2;
};

HWY_INLINE FloatPair toFloats(WordVector values)
{
  const Integers i;
  const Floats f;
  return {hn::ConvertTo(f, hn::PromoteTo(i, hn::LowerHalf(HalfWords(), values))),
          hn::ConvertTo(f, hn::PromoteTo(i, hn::UpperHalf(HalfWords(), values)))};
}

HWY_INLINE FloatPair unsignedToFloats(WordVector values)
{
  const Integers i;
  const Floats f;
  const auto as_unsigned = hn::BitCast(UnsignedWords(), values);
  return {hn::ConvertTo(f, hn::PromoteTo(i, hn::LowerHalf(HalfUnsigned(), as_unsigned))),
          hn::ConvertTo(f, hn::PromoteTo(i, hn::UpperHalf(HalfUnsigned(), as_unsigned)))};
}

/// Whole numbers, towards zero.
HWY_INLINE WordVector toWords(const FloatPair& values)
{
  const Integers i;
  const Words words;
  return hn::ConcatEven(words, hn::BitCast(words, hn::ConvertTo(i, values.high)),
                        hn::BitCast(words, hn::ConvertTo(i, values.low)));
}

HWY_INLINE Samples black()
{
  const auto zero = hn::Zero(Words());
  return {zero, zero, zero};
}

template <int CHANNELS>
HWY_INLINE void addWeighted(WordVector weight, const Samples& tap, Samples& sum)
{
  sum.c0 = hn::Add(sum.c0, hn::MulFixedPoint15(weight, tap.c0));
  if (CHANNELS == 3)
  {
    sum.c1 = hn::Add(sum.c1, hn::MulFixedPoint15(weight, tap.c1));
    sum.c2 = hn::Add(sum.c2, hn::MulFixedPoint15(weight, tap.c2));
  }
}

template <int CHANNELS>
HWY_INLINE Samples loadSamples(const std::uint8_t* pixels, std::size_t channel_stride)
{
  const Words words;
  const Bytes bytes;
  Samples samples;
  samples.c0 = hn::ShiftLeft<SAMPLE_SHIFT>(hn::PromoteTo(words, hn::LoadU(bytes, pixels)));
  samples.c1 = samples.c0;
  samples.c2 = samples.c0;
  if (CHANNELS == 3)
  {
    const std::uint8_t* const second = pixels + channel_stride;
    samples.c1 = hn::ShiftLeft<SAMPLE_SHIFT>(hn::PromoteTo(words, hn::LoadU(bytes, second)));
    samples.c2 = hn::ShiftLeft<SAMPLE_SHIFT>(hn::PromoteTo(words, hn::LoadU(bytes, second + channel_stride)));
  }
  return samples;
}

/// Shifts of a block along one axis: lane i takes its four taps from index base + delta[i] on.
struct Axis
{
  int base = 0;
  int span = 0;  ///< largest delta
  WordVector delta;
  WordVector weight0, weight1, weight2, weight3;
};

/// Smallest and largest disparity of a block, with all of them.
struct BlockDisparity
{
  FloatPair values;
  float least;
  float most;
};

HWY_INLINE Axis axisOf(const BlockDisparity& disparity, float offset, float step)
{
  const Floats f;
  const Words words;
  const float at_least = offset - disparity.least * step;
  const float at_most = offset - disparity.most * step;
  Axis axis;
  const float low = std::floor(std::min(at_least, at_most));
  axis.base = static_cast<int>(low) - 1;
  axis.span = static_cast<int>(std::floor(std::max(at_least, at_most)) - low);
  const auto shift = [&](FloatVector values) HWY_ATTR
  { return hn::Sub(hn::Set(f, offset), hn::Mul(values, hn::Set(f, step))); };
  const FloatPair shifts{shift(disparity.values.low), shift(disparity.values.high)};
  const FloatPair whole{hn::Floor(shifts.low), hn::Floor(shifts.high)};
  const auto one = hn::Set(f, TAP_ONE);
  const auto t =
      toWords({hn::Mul(hn::Sub(shifts.low, whole.low), one), hn::Mul(hn::Sub(shifts.high, whole.high), one)});
  axis.delta = t;
  if (axis.span > 0)
  {
    const auto least = hn::Set(f, low);
    axis.delta = toWords({hn::Sub(whole.low, least), hn::Sub(whole.high, least)});
  }
  // Catmull and Rom's, with u = 1 - t: -t u u / 2 and -t t u / 2 outside.
  const auto u = hn::Sub(hn::Set(words, TAP_MOST), t);
  const auto both = hn::MulFixedPoint15(t, u);
  const auto before = hn::ShiftRight<1>(hn::MulFixedPoint15(both, u));
  const auto after = hn::ShiftRight<1>(hn::MulFixedPoint15(both, t));
  axis.weight0 = hn::Neg(before);
  axis.weight1 = hn::Sub(hn::Add(hn::Add(before, before), u), after);
  axis.weight2 = hn::Sub(hn::Add(hn::Add(after, after), t), before);
  axis.weight3 = hn::Neg(after);
  return axis;
}

/// The weighted sum of the taps of all lanes. tap(j) is what lies at index base + j of every lane.
template <int CHANNELS, typename Tap>
HWY_INLINE Samples sumTaps(const Axis& axis, const Tap& tap)
{
  const Words words;
  Samples sum = black();
  if (axis.span == 0)
  {
    addWeighted<CHANNELS>(axis.weight0, tap(0), sum);
    addWeighted<CHANNELS>(axis.weight1, tap(1), sum);
    addWeighted<CHANNELS>(axis.weight2, tap(2), sum);
    addWeighted<CHANNELS>(axis.weight3, tap(3), sum);
    return sum;
  }
  if (axis.span == 1)
  {
    const auto later = hn::Gt(axis.delta, hn::Zero(words));
    addWeighted<CHANNELS>(hn::IfThenZeroElse(later, axis.weight0), tap(0), sum);
    addWeighted<CHANNELS>(hn::IfThenElse(later, axis.weight0, axis.weight1), tap(1), sum);
    addWeighted<CHANNELS>(hn::IfThenElse(later, axis.weight1, axis.weight2), tap(2), sum);
    addWeighted<CHANNELS>(hn::IfThenElse(later, axis.weight2, axis.weight3), tap(3), sum);
    addWeighted<CHANNELS>(hn::IfThenElseZero(later, axis.weight3), tap(4), sum);
    return sum;
  }
  // Lanes for which index j is the first tap, the second, and so on.
  const auto none = hn::Lt(axis.delta, hn::Zero(words));
  auto first = none;
  auto second = none;
  auto third = none;
  auto fourth = none;
  for (int j = 0; j <= axis.span + 3; ++j)
  {
    fourth = third;
    third = second;
    second = first;
    first = hn::Eq(axis.delta, hn::Set(words, static_cast<std::int16_t>(j)));
    if (hn::AllFalse(words, hn::Or(hn::Or(first, second), hn::Or(third, fourth))))
    {
      continue;
    }
    const auto late = hn::IfThenElse(third, axis.weight2, hn::IfThenElseZero(fourth, axis.weight3));
    const auto weight = hn::IfThenElse(first, axis.weight0, hn::IfThenElse(second, axis.weight1, late));
    addWeighted<CHANNELS>(weight, tap(j), sum);
  }
  return sum;
}

/// Taps along a row whose padding holds all that a block can touch.
template <int CHANNELS>
struct AlongRow
{
  const std::uint8_t* pixels;
  std::size_t channel_stride;

  HWY_INLINE Samples operator()(int tap) const { return loadSamples<CHANNELS>(pixels + tap, channel_stride); }
};

/// The same for a block that reaches beyond the padding.
template <int CHANNELS>
struct AlongRowClamped
{
  const std::uint8_t* row;
  std::size_t channel_stride;
  int first;
  int width;

  HWY_INLINE Samples operator()(int tap) const
  {
    constexpr std::size_t most_lanes = 32;
    const int lanes = static_cast<int>(hn::Lanes(Words()));
    std::uint8_t pixels[CHANNELS * most_lanes];
    for (int lane = 0; lane < lanes; ++lane)
    {
      const auto x = static_cast<std::size_t>(std::clamp(first + tap + lane, 0, width - 1));
      for (std::size_t c = 0; c < CHANNELS; ++c)
      {
        pixels[c * most_lanes + static_cast<std::size_t>(lane)] = row[c * channel_stride + x];
      }
    }
    return loadSamples<CHANNELS>(pixels, most_lanes);
  }
};

/// What the next row of the reference needs first. The caches of a core are smaller than the views, and too
/// many rows are read at a time for a processor to see what comes.
template <int CHANNELS>
HWY_INLINE void fetchAhead(const SampledView& view, const std::uint8_t* row, int x)
{
  for (std::size_t c = 0; c < CHANNELS; ++c)
  {
    hwy::Prefetch(row + c * view.channel_stride + x);
  }
}

HWY_INLINE const std::uint8_t* rowOf(const LinearizeTile& tile, const SampledView& view, int y)
{
  return view.pixels + static_cast<std::ptrdiff_t>(std::clamp(y, 0, tile.height - 1)) * view.row_stride;
}

/// @param x first column of the block
template <int CHANNELS>
HWY_INLINE Samples sampleRow(const LinearizeTile& tile, const SampledView& view, const std::uint8_t* row,
                             int x, const Axis& across)
{
  const int lanes = static_cast<int>(hn::Lanes(Words()));
  const int first = x + across.base;
  if (first >= -view.pad_before && first + across.span + 3 + lanes <= tile.width + view.pad_after)
  {
    return sumTaps<CHANNELS>(across, AlongRow<CHANNELS>{row + first, view.channel_stride});
  }
  return sumTaps<CHANNELS>(across, AlongRowClamped<CHANNELS>{row, view.channel_stride, first, tile.width});
}

/// Taps down the columns of a block.
template <int CHANNELS>
struct DownColumns
{
  const LinearizeTile& tile;
  const SampledView& view;
  int x;
  int first;

  HWY_INLINE Samples operator()(int tap) const
  {
    return loadSamples<CHANNELS>(rowOf(tile, view, first + tap) + x, view.channel_stride);
  }
};

/// Rows that are sampled across.
template <int CHANNELS>
struct DownRows
{
  const LinearizeTile& tile;
  const SampledView& view;
  const Axis& across;
  int x;
  int first;

  HWY_INLINE Samples operator()(int tap) const
  {
    return sampleRow<CHANNELS>(tile, view, rowOf(tile, view, first + tap), x, across);
  }
};

template <int CHANNELS>
HWY_INLINE Samples sampleView(const LinearizeTile& tile, const SampledView& view, int x,
                              const BlockDisparity& disparity)
{
  if (view.step_y == 0.0F && view.offset_y == 0.0F)
  {
    const Axis across = axisOf(disparity, view.offset_x, view.step_x);
    fetchAhead<CHANNELS>(view, rowOf(tile, view, tile.y + 1), x + across.base);
    return sampleRow<CHANNELS>(tile, view, rowOf(tile, view, tile.y), x, across);
  }
  const Axis down = axisOf(disparity, view.offset_y, view.step_y);
  const int first = tile.y + down.base;
  fetchAhead<CHANNELS>(view, rowOf(tile, view, first + down.span + 4), x);
  if (view.step_x == 0.0F && view.offset_x == 0.0F)
  {
    return sumTaps<CHANNELS>(down, DownColumns<CHANNELS>{tile, view, x, first});
  }
  const Axis across = axisOf(disparity, view.offset_x, view.step_x);
  return sumTaps<CHANNELS>(down, DownRows<CHANNELS>{tile, view, across, x, first});
}

HWY_INLINE BlockDisparity disparityAt(const float* disparity)
{
  const Floats f;
  BlockDisparity block{{hn::LoadU(f, disparity), hn::LoadU(f, disparity + hn::Lanes(f))}, 0.0F, 0.0F};
  block.least = hn::GetLane(hn::MinOfLanes(f, hn::Min(block.values.low, block.values.high)));
  block.most = hn::GetLane(hn::MaxOfLanes(f, hn::Max(block.values.low, block.values.high)));
  return block;
}

#endif  // HWY_TARGET != HWY_SCALAR
}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#endif
