// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "multiview/linearize_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "light_field_depth/core/multiview/cubic_taps.h"
#include "light_field_depth/core/multiview/linearize_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
#if HWY_TARGET == HWY_SCALAR
// A processor without any of the known vector instructions.
void linearizeTileSimd(const LinearizeTile& tile)
{
  linearizeTilePlain(tile);
}
#else
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Integers = hn::RebindToSigned<Floats>;
using FloatVector = hn::Vec<Floats>;
using IntegerVector = hn::Vec<Integers>;

/// Position along one axis with the weights of its four taps; the order of operations is that of
/// cubic_taps.h.
struct Axis
{
  IntegerVector first;
  FloatVector weight0, weight1, weight2, weight3;
};

HWY_INLINE Axis axisAt(FloatVector position)
{
  const Floats f;
  const Integers i;
  const auto c = [&](float value) HWY_ATTR { return hn::Set(f, value); };
  const auto whole = hn::Floor(position);
  const auto t = hn::Sub(position, whole);
  const auto t_half = hn::Mul(t, c(0.5F));
  const auto t_three_halves = hn::Mul(t, c(1.5F));
  Axis axis;
  axis.first = hn::Sub(hn::ConvertTo(i, whole), hn::Set(i, 1));
  axis.weight0 = hn::Mul(hn::Sub(hn::Mul(hn::Sub(c(1.0F), t_half), t), c(0.5F)), t);
  axis.weight1 = hn::Add(hn::Mul(hn::Mul(hn::Sub(t_three_halves, c(2.5F)), t), t), c(1.0F));
  axis.weight2 = hn::Mul(hn::Add(hn::Mul(hn::Sub(c(2.0F), t_three_halves), t), c(0.5F)), t);
  axis.weight3 = hn::Mul(hn::Mul(hn::Sub(t_half, c(0.5F)), t), t);
  return axis;
}

/// Up to three channels.
struct Colour
{
  FloatVector c0, c1, c2;
};

template <int CHANNEL>
HWY_INLINE FloatVector channelOf(IntegerVector pixel)
{
  const Integers i;
  return hn::ConvertTo(Floats(), hn::And(hn::ShiftRight<8 * CHANNEL>(pixel), hn::Set(i, 255)));
}

template <int CHANNELS>
HWY_INLINE void addScaled(FloatVector weight, const Colour& colour, Colour& sum)
{
  sum.c0 = hn::Add(sum.c0, hn::Mul(weight, colour.c0));
  if (CHANNELS == 3)
  {
    sum.c1 = hn::Add(sum.c1, hn::Mul(weight, colour.c1));
    sum.c2 = hn::Add(sum.c2, hn::Mul(weight, colour.c2));
  }
}

template <int CHANNELS>
HWY_INLINE void addTap(IntegerVector pixel, FloatVector weight, Colour& sum)
{
  Colour colour{channelOf<0>(pixel), weight, weight};
  if (CHANNELS == 3)
  {
    colour.c1 = channelOf<1>(pixel);
    colour.c2 = channelOf<2>(pixel);
  }
  addScaled<CHANNELS>(weight, colour, sum);
}

HWY_INLINE Colour black()
{
  const auto zero = hn::Zero(Floats());
  return {zero, zero, zero};
}

HWY_INLINE IntegerVector clampedIndex(IntegerVector index, int offset, int count)
{
  const Integers i;
  return hn::Min(hn::Max(hn::Add(index, hn::Set(i, offset)), hn::Zero(i)), hn::Set(i, count - 1));
}

template <int CHANNELS>
HWY_INLINE Colour sampleLine(const SampledView& view, const Axis& axis, int count, int stride,
                             IntegerVector offset)
{
  const Integers i;
  const auto* const pixels = reinterpret_cast<const std::int32_t*>(view.pixels);
  const auto stride_vector = hn::Set(i, stride);
  const auto gather = [&](int tap) HWY_ATTR
  {
    const auto index = clampedIndex(axis.first, tap, count);
    return hn::GatherOffset(i, pixels, hn::Add(offset, hn::Mul(index, stride_vector)));
  };
  Colour sample = black();
  addTap<CHANNELS>(gather(0), axis.weight0, sample);
  addTap<CHANNELS>(gather(1), axis.weight1, sample);
  addTap<CHANNELS>(gather(2), axis.weight2, sample);
  addTap<CHANNELS>(gather(3), axis.weight3, sample);
  return sample;
}

template <int CHANNELS>
HWY_INLINE void addLine(const LinearizeTile& tile, const SampledView& view, const Axis& across,
                        const Axis& down, int tap, FloatVector weight, Colour& sample)
{
  const Integers i;
  const auto offset = hn::Mul(clampedIndex(down.first, tap, tile.height), hn::Set(i, view.row_stride));
  addScaled<CHANNELS>(weight, sampleLine<CHANNELS>(view, across, tile.width, view.pixel_stride, offset),
                      sample);
}

template <int CHANNELS>
HWY_INLINE Colour sampleView(const LinearizeTile& tile, const SampledView& view, FloatVector x,
                             FloatVector disparity)
{
  const Floats f;
  const Integers i;
  const auto position = [&](FloatVector start, float offset, float step) HWY_ATTR
  { return hn::Add(start, hn::Sub(hn::Set(f, offset), hn::Mul(disparity, hn::Set(f, step)))); };
  const auto at_x = position(x, view.offset_x, view.step_x);
  const auto at_y = position(hn::Set(f, static_cast<float>(tile.y)), view.offset_y, view.step_y);
  if (view.step_y == 0.0F && view.offset_y == 0.0F)
  {
    return sampleLine<CHANNELS>(view, axisAt(at_x), tile.width, view.pixel_stride,
                                hn::Set(i, tile.y * view.row_stride));
  }
  if (view.step_x == 0.0F && view.offset_x == 0.0F)
  {
    const auto column = hn::Mul(hn::ConvertTo(i, x), hn::Set(i, view.pixel_stride));
    return sampleLine<CHANNELS>(view, axisAt(at_y), tile.height, view.row_stride, column);
  }
  const Axis across = axisAt(at_x);
  const Axis down = axisAt(at_y);
  Colour sample = black();
  addLine<CHANNELS>(tile, view, across, down, 0, down.weight0, sample);
  addLine<CHANNELS>(tile, view, across, down, 1, down.weight1, sample);
  addLine<CHANNELS>(tile, view, across, down, 2, down.weight2, sample);
  addLine<CHANNELS>(tile, view, across, down, 3, down.weight3, sample);
  return sample;
}

/// Sum of the absolute differences; a grey image counts three times.
template <int CHANNELS>
HWY_INLINE FloatVector mismatch(const Colour& a, const Colour& b)
{
  auto sum = hn::Abs(hn::Sub(a.c0, b.c0));
  if (CHANNELS == 3)
  {
    sum = hn::Add(hn::Add(sum, hn::Abs(hn::Sub(a.c1, b.c1))), hn::Abs(hn::Sub(a.c2, b.c2)));
    return sum;
  }
  return hn::Mul(sum, hn::Set(Floats(), 3.0F));
}

template <int CHANNELS>
HWY_INLINE Colour referenceAt(const LinearizeTile& tile, int x)
{
  const Floats f;
  const hn::Rebind<std::uint8_t, Floats> bytes;
  const auto channel = [&](std::size_t c) HWY_ATTR
  {
    const auto pixels = hn::LoadU(bytes, tile.reference + c * tile.reference_stride + x);
    return hn::ConvertTo(f, hn::PromoteTo(Integers(), pixels));
  };
  const auto first = channel(0);
  return CHANNELS == 3 ? Colour{first, channel(1), channel(2)} : Colour{first, first, first};
}

template <int CHANNELS>
HWY_INLINE void storeColour(const Colour& colour, std::size_t stride, float* values)
{
  const Floats f;
  hn::StoreU(colour.c0, f, values);
  if (CHANNELS == 3)
  {
    hn::StoreU(colour.c1, f, values + stride);
    hn::StoreU(colour.c2, f, values + 2 * stride);
  }
}

template <int CHANNELS>
HWY_INLINE Colour loadColour(const float* values, std::size_t stride)
{
  const Floats f;
  const auto first = hn::LoadU(f, values);
  return CHANNELS == 3 ? Colour{first, hn::LoadU(f, values + stride), hn::LoadU(f, values + 2 * stride)}
                       : Colour{first, first, first};
}

template <int CHANNELS>
HWY_INLINE void sumSpoke(const LinearizeTile& tile, const Spoke& spoke, const Colour& reference,
                         const Colour& mean, int in_tile, float* moments)
{
  const Floats f;
  const auto channel_weight = hn::Set(f, 3.0F / static_cast<float>(CHANNELS));
  auto residual = hn::Zero(f);
  auto kk = hn::Zero(f);
  Colour kr = black();
  for (int view = spoke.first; view < spoke.last; ++view)
  {
    const Colour sample =
        loadColour<CHANNELS>(tile.values + view * CHANNELS * TILE_PIXELS + in_tile, TILE_PIXELS);
    const auto e = mismatch<CHANNELS>(sample, reference);
    const auto k = hn::Set(f, tile.views[view].position);
    const auto weight_k = hn::Mul(hn::Div(channel_weight, hn::Add(e, hn::Set(f, RESIDUAL_SOFTENING))), k);
    residual = hn::Add(residual, e);
    kk = hn::Add(kk, hn::Mul(weight_k, k));
    const Colour difference{hn::Sub(sample.c0, mean.c0), hn::Sub(sample.c1, mean.c1),
                            hn::Sub(sample.c2, mean.c2)};
    addScaled<CHANNELS>(weight_k, difference, kr);
  }
  hn::StoreU(residual, f, moments + SPOKE_RESIDUAL * tile.stride);
  hn::StoreU(kk, f, moments + SPOKE_KK * tile.stride);
  storeColour<CHANNELS>(kr, tile.stride, moments + SPOKE_KR * tile.stride);
}

template <int CHANNELS>
HWY_INLINE void linearizePixels(const LinearizeTile& tile, int x)
{
  const Floats f;
  const auto columns =
      hn::Min(hn::Iota(f, static_cast<float>(x)), hn::Set(f, static_cast<float>(tile.width - 1)));
  const auto disparity = hn::LoadU(f, tile.disparity + x);
  const auto scale = hn::Set(f, tile.match_scale * tile.match_scale);
  const int in_tile = x - tile.first;
  const Colour reference = referenceAt<CHANNELS>(tile, x);
  Colour mean = reference;
  auto total = hn::Set(f, 1.0F);
  for (int view = 0; view < tile.view_count; ++view)
  {
    const Colour sample = sampleView<CHANNELS>(tile, tile.views[view], columns, disparity);
    const auto e = mismatch<CHANNELS>(sample, reference);
    const auto share = hn::Div(scale, hn::Add(hn::Mul(e, e), scale));
    const auto weight = hn::Mul(share, share);
    total = hn::Add(total, weight);
    addScaled<CHANNELS>(weight, sample, mean);
    storeColour<CHANNELS>(sample, TILE_PIXELS, tile.values + view * CHANNELS * TILE_PIXELS + in_tile);
  }
  mean.c0 = hn::Div(mean.c0, total);
  mean.c1 = CHANNELS == 3 ? hn::Div(mean.c1, total) : mean.c0;
  mean.c2 = CHANNELS == 3 ? hn::Div(mean.c2, total) : mean.c0;
  storeColour<CHANNELS>(mean, tile.refocused_stride, tile.refocused + x);
  for (int spoke = 0; spoke < tile.spoke_count; ++spoke)
  {
    sumSpoke<CHANNELS>(tile, tile.spokes[spoke], reference, mean, in_tile,
                       tile.moments + static_cast<std::size_t>(spoke) * SPOKE_MOMENTS * tile.stride + x);
  }
}

void linearizeTileSimd(const LinearizeTile& tile)
{
  const int lanes = static_cast<int>(hn::Lanes(Floats()));
  const int last = std::min(tile.width, tile.first + TILE_PIXELS);
  for (int x = tile.first; x < last; x += lanes)
  {
    if (tile.channels == 3)
    {
      linearizePixels<3>(tile, x);
    }
    else
    {
      linearizePixels<1>(tile, x);
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
HWY_EXPORT(linearizeTileSimd);

void linearizeTile(const LinearizeTile& tile)
{
  HWY_DYNAMIC_DISPATCH(linearizeTileSimd)(tile);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
