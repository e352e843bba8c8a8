// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/refine/linearize_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "core/multiview/refine/cubic_samples-inl.h"
#include "core/multiview/refine/cubic_taps.h"
#include "core/multiview/refine/linearize_kernels.h"

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

/// What is summed over views: numbers of one half of the lanes.
struct Sums
{
  FloatVector total, mean0, mean1, mean2;           // of all views
  FloatVector residual, kk, weight, kr0, kr1, kr2;  // of one ray
};

template <int CHANNELS>
HWY_INLINE void addView(FloatVector mismatch, FloatVector d0, FloatVector d1, FloatVector d2, float scale,
                        float position, Sums& sums)
{
  const Floats f;
  const auto e = CHANNELS == 3 ? mismatch : hn::Mul(mismatch, hn::Set(f, 3.0F));
  const auto k = hn::Set(f, position);
  const auto spread = hn::Add(hn::Mul(e, e), hn::Set(f, scale));
  const auto softened = hn::Add(e, hn::Set(f, RESIDUAL_SOFTENING * SAMPLE_UNIT));
  const auto inverse = hn::Div(hn::Set(f, 1.0F), hn::Mul(spread, softened));
  const auto share = hn::Mul(hn::Mul(hn::Set(f, scale), softened), inverse);
  const auto in_mean = hn::Mul(share, share);
  const auto weight_k = hn::Mul(hn::Mul(hn::Set(f, position * (3.0F / CHANNELS)), spread), inverse);
  sums.total = hn::Add(sums.total, in_mean);
  sums.residual = hn::Add(sums.residual, e);
  sums.kk = hn::Add(sums.kk, hn::Mul(weight_k, k));
  sums.weight = hn::Add(sums.weight, weight_k);
  sums.mean0 = hn::Add(sums.mean0, hn::Mul(in_mean, d0));
  sums.kr0 = hn::Add(sums.kr0, hn::Mul(weight_k, d0));
  if (CHANNELS == 3)
  {
    sums.mean1 = hn::Add(sums.mean1, hn::Mul(in_mean, d1));
    sums.kr1 = hn::Add(sums.kr1, hn::Mul(weight_k, d1));
    sums.mean2 = hn::Add(sums.mean2, hn::Mul(in_mean, d2));
    sums.kr2 = hn::Add(sums.kr2, hn::Mul(weight_k, d2));
  }
}

/// @param weights of the ray, for the block
template <int CHANNELS>
HWY_INLINE void storeRay(const Sums& sums, std::size_t stride, float* moments, float* weights)
{
  const Floats f;
  hn::StoreU(hn::Mul(sums.residual, hn::Set(f, 1.0F / SAMPLE_UNIT)), f, moments + RAY_RESIDUAL * stride);
  hn::StoreU(hn::Mul(sums.kk, hn::Set(f, SAMPLE_UNIT)), f, moments + RAY_KK * stride);
  hn::StoreU(sums.weight, f, weights);
  hn::StoreU(sums.kr0, f, moments + RAY_KR * stride);
  if (CHANNELS == 3)
  {
    hn::StoreU(sums.kr1, f, moments + (RAY_KR + 1) * stride);
    hn::StoreU(sums.kr2, f, moments + (RAY_KR + 2) * stride);
  }
}

/// Differences to the reference become differences to the mean.
HWY_INLINE void centre(FloatVector mean, FloatVector weight, float* kr)
{
  const Floats f;
  hn::StoreU(hn::Sub(hn::LoadU(f, kr), hn::Mul(weight, mean)), f, kr);
}

template <int CHANNELS>
HWY_INLINE void finish(const LinearizeTile& tile, const Samples& reference, int x, Sums (&halves)[2])
{
  const Floats f;
  const auto unit = hn::Set(f, 1.0F / SAMPLE_UNIT);
  const std::size_t lanes = hn::Lanes(f);
  const auto channel = [&](FloatVector& low, FloatVector& high, WordVector here, std::size_t c) HWY_ATTR
  {
    low = hn::Div(low, halves[0].total);
    high = hn::Div(high, halves[1].total);
    const FloatPair start = toFloats(here);
    float* const refocused = tile.refocused + c * tile.refocused_stride + x;
    hn::StoreU(hn::Mul(hn::Add(start.low, low), unit), f, refocused);
    hn::StoreU(hn::Mul(hn::Add(start.high, high), unit), f, refocused + lanes);
  };
  channel(halves[0].mean0, halves[1].mean0, reference.c0, 0);
  if (CHANNELS == 3)
  {
    channel(halves[0].mean1, halves[1].mean1, reference.c1, 1);
    channel(halves[0].mean2, halves[1].mean2, reference.c2, 2);
  }
  for (std::size_t ray = 0; ray < static_cast<std::size_t>(tile.ray_count); ++ray)
  {
    for (std::size_t half = 0; half < 2; ++half)
    {
      const std::size_t in_row = static_cast<std::size_t>(x) + half * lanes;
      const auto weight =
          hn::LoadU(f, tile.weights + ray * TILE_PIXELS + in_row - static_cast<std::size_t>(tile.first));
      float* const kr = tile.moments + (ray * RAY_MOMENTS + RAY_KR) * tile.stride + in_row;
      centre(halves[half].mean0, weight, kr);
      if (CHANNELS == 3)
      {
        centre(halves[half].mean1, weight, kr + tile.stride);
        centre(halves[half].mean2, weight, kr + 2 * tile.stride);
      }
    }
  }
}

HWY_INLINE void beginRay(Sums& sums)
{
  const auto zero = hn::Zero(Floats());
  sums.residual = sums.kk = sums.weight = sums.kr0 = sums.kr1 = sums.kr2 = zero;
}

template <int CHANNELS>
HWY_INLINE void linearizeBlock(const LinearizeTile& tile, int x)
{
  const Floats f;
  const std::size_t lanes = hn::Lanes(f);
  const BlockDisparity disparity = disparityAt(tile.disparity + x);
  const Samples reference = loadSamples<CHANNELS>(tile.reference + x, tile.reference_stride);
  const float scale = tile.match_scale * tile.match_scale * (SAMPLE_UNIT * SAMPLE_UNIT);
  Sums halves[2];
  for (Sums& sums : halves)
  {
    sums.total = hn::Set(f, 1.0F);
    sums.mean0 = sums.mean1 = sums.mean2 = hn::Zero(f);
  }
  for (int ray = 0; ray < tile.ray_count; ++ray)
  {
    beginRay(halves[0]);
    beginRay(halves[1]);
    for (int i = tile.rays[ray].first; i < tile.rays[ray].last; ++i)
    {
      const Samples sample = sampleView<CHANNELS>(tile, tile.views[i], x, disparity);
      const auto d0 = hn::Sub(sample.c0, reference.c0);
      auto mismatch = hn::Abs(d0);
      FloatPair difference0 = toFloats(d0);
      FloatPair difference1 = difference0;
      FloatPair difference2 = difference0;
      if (CHANNELS == 3)
      {
        const auto d1 = hn::Sub(sample.c1, reference.c1);
        const auto d2 = hn::Sub(sample.c2, reference.c2);
        mismatch = hn::Add(hn::Add(mismatch, hn::Abs(d1)), hn::Abs(d2));
        difference1 = toFloats(d1);
        difference2 = toFloats(d2);
      }
      const FloatPair e = unsignedToFloats(mismatch);
      const float position = tile.views[i].position;
      addView<CHANNELS>(e.low, difference0.low, difference1.low, difference2.low, scale, position, halves[0]);
      addView<CHANNELS>(e.high, difference0.high, difference1.high, difference2.high, scale, position,
                        halves[1]);
    }
    float* const moments = tile.moments + static_cast<std::size_t>(ray) * RAY_MOMENTS * tile.stride + x;
    float* const weights = tile.weights + ray * TILE_PIXELS + (x - tile.first);
    storeRay<CHANNELS>(halves[0], tile.stride, moments, weights);
    storeRay<CHANNELS>(halves[1], tile.stride, moments + lanes, weights + lanes);
  }
  finish<CHANNELS>(tile, reference, x, halves);
}

void linearizeTileSimd(const LinearizeTile& tile)
{
  const int lanes = static_cast<int>(hn::Lanes(Words()));
  const int last = std::min(tile.width, tile.first + TILE_PIXELS);
  for (int x = tile.first; x < last; x += lanes)
  {
    if (tile.channels == 3)
    {
      linearizeBlock<3>(tile, x);
    }
    else
    {
      linearizeBlock<1>(tile, x);
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
