#include <algorithm>
#include <array>
#include <cmath>

#include "light_field_depth/core/multiview/cubic_taps.h"
#include "light_field_depth/core/multiview/linearize_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
using Values = std::array<float, 3>;

struct Axis
{
  int first = 0;  ///< pixel of the first tap
  std::array<float, 4> weight{};
};

Axis axisAt(float position)
{
  const float whole = std::floor(position);
  const float t = position - whole;
  return {static_cast<int>(whole) - 1, {cubicValue0(t), cubicValue1(t), cubicValue2(t), cubicValue3(t)}};
}

/// One line of four taps: pixels `offset` + clamp(first + i, 0, count - 1) * stride.
Values sampleLine(const LinearizeTile& tile, const SampledView& view, const Axis& axis, int count, int stride,
                  int offset)
{
  Values sample{};
  for (int tap = 0; tap < 4; ++tap)
  {
    const int index = std::clamp(axis.first + tap, 0, count - 1);
    const std::uint8_t* const pixel = view.pixels + offset + static_cast<std::ptrdiff_t>(index) * stride;
    for (std::size_t c = 0; c < static_cast<std::size_t>(tile.channels); ++c)
    {
      sample[c] = sample[c] + axis.weight[static_cast<std::size_t>(tap)] * static_cast<float>(pixel[c]);
    }
  }
  return sample;
}

Values sampleAcross(const LinearizeTile& tile, const SampledView& view, const Axis& across, const Axis& down)
{
  Values sample{};
  for (int tap = 0; tap < 4; ++tap)
  {
    const int offset = std::clamp(down.first + tap, 0, tile.height - 1) * view.row_stride;
    const Values line = sampleLine(tile, view, across, tile.width, view.pixel_stride, offset);
    for (std::size_t c = 0; c < static_cast<std::size_t>(tile.channels); ++c)
    {
      sample[c] = sample[c] + down.weight[static_cast<std::size_t>(tap)] * line[c];
    }
  }
  return sample;
}

Values sampleView(const LinearizeTile& tile, const SampledView& view, int x)
{
  const float d = tile.disparity[x];
  const float at_x = static_cast<float>(x) + (view.offset_x - d * view.step_x);
  const float at_y = static_cast<float>(tile.y) + (view.offset_y - d * view.step_y);
  if (view.step_y == 0.0F && view.offset_y == 0.0F)
  {
    return sampleLine(tile, view, axisAt(at_x), tile.width, view.pixel_stride, tile.y * view.row_stride);
  }
  if (view.step_x == 0.0F && view.offset_x == 0.0F)
  {
    return sampleLine(tile, view, axisAt(at_y), tile.height, view.row_stride, x * view.pixel_stride);
  }
  return sampleAcross(tile, view, axisAt(at_x), axisAt(at_y));
}

/// Sum of the absolute differences to the reference; a grey image counts three times.
float mismatch(const LinearizeTile& tile, const Values& sample, const Values& reference)
{
  float sum = 0.0F;
  for (std::size_t c = 0; c < static_cast<std::size_t>(tile.channels); ++c)
  {
    sum = sum + std::abs(sample[c] - reference[c]);
  }
  return sum * (3.0F / static_cast<float>(tile.channels));
}

void linearizePixel(const LinearizeTile& tile, std::size_t x)
{
  const auto channels = static_cast<std::size_t>(tile.channels);
  const float channel_weight = 3.0F / static_cast<float>(tile.channels);
  const float scale = tile.match_scale * tile.match_scale;
  const std::size_t in_tile = x - static_cast<std::size_t>(tile.first);
  Values reference{};
  for (std::size_t c = 0; c < channels; ++c)
  {
    reference[c] = static_cast<float>(tile.reference[c * tile.reference_stride + x]);
  }
  const auto value_at = [&](int view, std::size_t c) -> float&
  { return tile.values[(static_cast<std::size_t>(view) * channels + c) * TILE_PIXELS + in_tile]; };
  Values mean = reference;
  float total = 1.0F;
  for (int view = 0; view < tile.view_count; ++view)
  {
    const Values sample = sampleView(tile, tile.views[view], static_cast<int>(x));
    const float e = mismatch(tile, sample, reference);
    const float share = scale / (e * e + scale);
    const float weight = share * share;
    total = total + weight;
    for (std::size_t c = 0; c < channels; ++c)
    {
      value_at(view, c) = sample[c];
      mean[c] = mean[c] + weight * sample[c];
    }
  }
  for (std::size_t c = 0; c < channels; ++c)
  {
    mean[c] = mean[c] / total;
    tile.refocused[c * tile.refocused_stride + x] = mean[c];
  }
  for (int spoke = 0; spoke < tile.spoke_count; ++spoke)
  {
    std::array<float, SPOKE_MOMENTS> sums{};
    for (int view = tile.spokes[spoke].first; view < tile.spokes[spoke].last; ++view)
    {
      Values sample{};
      for (std::size_t c = 0; c < channels; ++c)
      {
        sample[c] = value_at(view, c);
      }
      const float e = mismatch(tile, sample, reference);
      const float k = tile.views[view].position;
      const float weight_k = channel_weight / (e + RESIDUAL_SOFTENING) * k;
      sums[SPOKE_RESIDUAL] = sums[SPOKE_RESIDUAL] + e;
      sums[SPOKE_KK] = sums[SPOKE_KK] + weight_k * k;
      for (std::size_t c = 0; c < channels; ++c)
      {
        sums[SPOKE_KR + c] = sums[SPOKE_KR + c] + weight_k * (sample[c] - mean[c]);
      }
    }
    float* const moments = tile.moments + static_cast<std::size_t>(spoke) * SPOKE_MOMENTS * tile.stride + x;
    for (std::size_t moment = 0; moment < SPOKE_KR + channels; ++moment)
    {
      moments[moment * tile.stride] = sums[moment];
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

}  // namespace light_field_depth::multiview
