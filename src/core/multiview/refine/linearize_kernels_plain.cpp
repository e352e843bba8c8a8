#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "core/multiview/refine/cubic_taps.h"
#include "core/multiview/refine/linearize_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int TAPS = 4;  // of a cubic
/// Residual of a view that is masked where no other of its ray tells: as of one that shows something else.
constexpr float MASKED_RESIDUAL = 100.0F;
using Samples = std::array<int, 3>;

struct Axis
{
  int first = 0;  ///< index of the first tap
  std::array<int, TAPS> weight{};
};

Axis axisAt(int start, float disparity, float offset, float step)
{
  const float shift = offset - disparity * step;
  const float whole = std::floor(shift);
  return {start + static_cast<int>(whole) - 1, cubicTaps(shift - whole)};
}

Samples sampleRow(const LinearizeTile& tile, const SampledView& view, const Axis& across, int y)
{
  const std::uint8_t* const row = view.pixels + std::clamp(y, 0, tile.height - 1) * view.row_stride;
  Samples sample{};
  for (int tap = 0; tap < TAPS; ++tap)
  {
    const auto x = static_cast<std::size_t>(std::clamp(across.first + tap, 0, tile.width - 1));
    for (std::size_t c = 0; c < static_cast<std::size_t>(tile.channels); ++c)
    {
      sample[c] += mulFixed(across.weight[static_cast<std::size_t>(tap)],
                            static_cast<int>(row[c * view.channel_stride + x]) << SAMPLE_SHIFT);
    }
  }
  return sample;
}

Samples sampleRows(const LinearizeTile& tile, const Axis& down, const Samples (&rows)[TAPS])
{
  Samples sample{};
  for (std::size_t tap = 0; tap < TAPS; ++tap)
  {
    for (std::size_t c = 0; c < static_cast<std::size_t>(tile.channels); ++c)
    {
      sample[c] += mulFixed(down.weight[tap], rows[tap][c]);
    }
  }
  return sample;
}

/// The pixels of a column without interpolation across.
Samples pixelAt(const LinearizeTile& tile, const SampledView& view, int x, int y)
{
  const std::uint8_t* const row = view.pixels + std::clamp(y, 0, tile.height - 1) * view.row_stride;
  Samples sample{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(tile.channels); ++c)
  {
    sample[c] = static_cast<int>(row[c * view.channel_stride + static_cast<std::size_t>(x)]) << SAMPLE_SHIFT;
  }
  return sample;
}

Samples sampleView(const LinearizeTile& tile, const SampledView& view, int x)
{
  const float d = tile.disparity[x];
  const Axis across = axisAt(x, d, view.offset_x, view.step_x);
  if (view.step_y == 0.0F && view.offset_y == 0.0F)
  {
    return sampleRow(tile, view, across, tile.y);
  }
  const Axis down = axisAt(tile.y, d, view.offset_y, view.step_y);
  const bool in_column = view.step_x == 0.0F && view.offset_x == 0.0F;
  Samples rows[TAPS];
  for (int tap = 0; tap < TAPS; ++tap)
  {
    rows[tap] = in_column ? pixelAt(tile, view, x, down.first + tap)
                          : sampleRow(tile, view, across, down.first + tap);
  }
  return sampleRows(tile, down, rows);
}

/// @param x of the reference's pixel
bool isMasked(const LinearizeTile& tile, const SampledView& view, int x)
{
  if (tile.reference_masked != nullptr && tile.reference_masked[x] != 0)
  {
    return true;
  }
  if (view.masked == nullptr)
  {
    return false;
  }
  const float d = tile.disparity[x];
  const auto nearest = [d](int from, float offset, float step, int size)
  { return std::clamp(from + static_cast<int>(std::floor(offset - d * step + 0.5F)), 0, size - 1); };
  const int row = nearest(tile.y, view.offset_y, view.step_y, tile.height);
  return view.masked[row * view.masked_stride + nearest(x, view.offset_x, view.step_x, tile.width)] != 0;
}

/// Sums over the views of a pixel; samples in units of 1 / SAMPLE_UNIT.
struct MeanSums
{
  float total = 1.0F;
  std::array<float, 3> difference{};
};

struct RaySums
{
  float residual = 0.0F;
  float kk = 0.0F;
  float weight = 0.0F;
  std::array<float, 3> kr{};
};

void addView(const LinearizeTile& tile, const Samples& sample, const Samples& reference, float k,
             MeanSums& mean, RaySums& ray)
{
  const float channel_weight = 3.0F / static_cast<float>(tile.channels);
  int mismatch = 0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(tile.channels); ++c)
  {
    mismatch += std::abs(sample[c] - reference[c]);
  }
  const float scale = tile.match_scale * tile.match_scale * (SAMPLE_UNIT * SAMPLE_UNIT);
  const float e = static_cast<float>(mismatch) * channel_weight;
  const float spread = e * e + scale;
  const float softened = e + RESIDUAL_SOFTENING * SAMPLE_UNIT;
  const float inverse = 1.0F / (spread * softened);
  const float share = scale * softened * inverse;
  const float in_mean = share * share;
  const float weight_k = k * channel_weight * spread * inverse;
  mean.total += in_mean;
  ray.residual += e;
  ray.kk += weight_k * k;
  ray.weight += weight_k;
  for (std::size_t c = 0; c < static_cast<std::size_t>(tile.channels); ++c)
  {
    const auto difference = static_cast<float>(sample[c] - reference[c]);
    mean.difference[c] += in_mean * difference;
    ray.kr[c] += weight_k * difference;
  }
}

void linearizePixel(const LinearizeTile& tile, std::size_t x)
{
  const auto channels = static_cast<std::size_t>(tile.channels);
  const std::size_t in_tile = x - static_cast<std::size_t>(tile.first);
  const auto momentsOf = [&](int ray)
  { return tile.moments + static_cast<std::size_t>(ray) * RAY_MOMENTS * tile.stride + x; };
  const auto weightOf = [&](int ray) -> float&
  { return tile.weights[static_cast<std::size_t>(ray) * TILE_PIXELS + in_tile]; };
  Samples reference{};
  for (std::size_t c = 0; c < channels; ++c)
  {
    reference[c] = static_cast<int>(tile.reference[c * tile.reference_stride + x]) << SAMPLE_SHIFT;
  }
  MeanSums mean;
  for (int ray = 0; ray < tile.ray_count; ++ray)
  {
    RaySums sums;
    int seeing = 0;
    for (int view = tile.rays[ray].first; view < tile.rays[ray].last; ++view)
    {
      if (isMasked(tile, tile.views[view], static_cast<int>(x)))
      {
        continue;
      }
      ++seeing;
      const Samples sample = sampleView(tile, tile.views[view], static_cast<int>(x));
      addView(tile, sample, reference, tile.views[view].position, mean, sums);
    }
    const int views = tile.rays[ray].last - tile.rays[ray].first;
    if (seeing < views)
    {
      const auto count = static_cast<float>(views);
      sums.residual = seeing > 0 ? sums.residual * count / static_cast<float>(seeing)
                                 : MASKED_RESIDUAL * SAMPLE_UNIT * count;
    }
    float* const moments = momentsOf(ray);
    moments[RAY_RESIDUAL * tile.stride] = sums.residual * (1.0F / SAMPLE_UNIT);
    moments[RAY_KK * tile.stride] = sums.kk * SAMPLE_UNIT;
    weightOf(ray) = sums.weight;
    for (std::size_t c = 0; c < channels; ++c)
    {
      moments[(RAY_KR + c) * tile.stride] = sums.kr[c];
    }
  }
  for (std::size_t c = 0; c < channels; ++c)
  {
    mean.difference[c] /= mean.total;
    tile.refocused[c * tile.refocused_stride + x] =
        (static_cast<float>(reference[c]) + mean.difference[c]) * (1.0F / SAMPLE_UNIT);
    for (int ray = 0; ray < tile.ray_count; ++ray)
    {
      momentsOf(ray)[(RAY_KR + c) * tile.stride] -= weightOf(ray) * mean.difference[c];
    }
  }
}

}  // namespace

void linearizeTilePlain(const LinearizeTile& tile)
{
  const auto last = static_cast<std::size_t>(std::min(tile.width, tile.first + TILE_PIXELS));
  for (auto x = static_cast<std::size_t>(tile.first); x < last; ++x)
  {
    linearizePixel(tile, x);
  }
}

void linearizeMaskedPixels(const LinearizeTile& tile)
{
  const int last = std::min(tile.width, tile.first + TILE_PIXELS);
  const SampledView* const end = tile.views + tile.rays[tile.ray_count - 1].last;
  for (int x = tile.first; x < last; ++x)
  {
    if (std::any_of(tile.views, end, [&](const SampledView& view) { return isMasked(tile, view, x); }))
    {
      linearizePixel(tile, static_cast<std::size_t>(x));
    }
  }
}

}  // namespace light_field_depth::multiview
