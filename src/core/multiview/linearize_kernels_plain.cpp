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
  std::array<float, 4> value{};
  std::array<float, 4> slope{};
};

Axis axisAt(float position)
{
  const float whole = std::floor(position);
  const float t = position - whole;
  Axis axis;
  axis.first = static_cast<int>(whole) - 1;
  axis.value = {cubicValue0(t), cubicValue1(t), cubicValue2(t), cubicValue3(t)};
  axis.slope = {cubicSlope0(t), cubicSlope1(t), cubicSlope2(t), cubicSlope3(t)};
  return axis;
}

/// Value and derivative along the view's steps, a channel each.
struct Sample
{
  Values value{};
  Values slope{};
};

/// One line of four taps: pixels `offset` + clamp(first + i, 0, count - 1) * stride.
Sample sampleLine(const LinearizeRow& row, const Axis& axis, int count, int stride, int offset)
{
  Sample sample;
  for (int tap = 0; tap < 4; ++tap)
  {
    const auto i = static_cast<std::size_t>(tap);
    const int index = std::clamp(axis.first + tap, 0, count - 1);
    const std::uint8_t* const pixel = row.pixels + offset + static_cast<std::ptrdiff_t>(index) * stride;
    for (std::size_t c = 0; c < static_cast<std::size_t>(row.channels); ++c)
    {
      const auto brightness = static_cast<float>(pixel[c]);
      sample.value[c] = sample.value[c] + axis.value[i] * brightness;
      sample.slope[c] = sample.slope[c] + axis.slope[i] * brightness;
    }
  }
  return sample;
}

Sample sampleAlong(const LinearizeRow& row, const Axis& axis, int count, int stride, int offset, float step)
{
  Sample sample = sampleLine(row, axis, count, stride, offset);
  for (float& slope : sample.slope)
  {
    slope = slope * -step;
  }
  return sample;
}

Sample sampleAcross(const LinearizeRow& row, const Axis& across, const Axis& down)
{
  Sample sample;
  for (int tap = 0; tap < 4; ++tap)
  {
    const auto i = static_cast<std::size_t>(tap);
    const int offset = std::clamp(down.first + tap, 0, row.height - 1) * row.row_stride;
    const Sample line = sampleLine(row, across, row.width, row.pixel_stride, offset);
    for (std::size_t c = 0; c < static_cast<std::size_t>(row.channels); ++c)
    {
      sample.value[c] = sample.value[c] + down.value[i] * line.value[c];
      sample.slope[c] = sample.slope[c] + (down.value[i] * line.slope[c] * -row.step_x +
                                           down.slope[i] * line.value[c] * -row.step_y);
    }
  }
  return sample;
}

Sample sampleView(const LinearizeRow& row, int x)
{
  const float d = row.disparity[x];
  const float at_x = static_cast<float>(x) + (row.offset_x - d * row.step_x);
  const float at_y = static_cast<float>(row.y) + (row.offset_y - d * row.step_y);
  if (row.step_y == 0.0F && row.offset_y == 0.0F)
  {
    return sampleAlong(row, axisAt(at_x), row.width, row.pixel_stride, row.y * row.row_stride, row.step_x);
  }
  if (row.step_x == 0.0F && row.offset_x == 0.0F)
  {
    return sampleAlong(row, axisAt(at_y), row.height, row.row_stride, x * row.pixel_stride, row.step_y);
  }
  return sampleAcross(row, axisAt(at_x), axisAt(at_y));
}

}  // namespace

void linearizeRowPlain(const LinearizeRow& row)
{
  const std::size_t width = row.moment_stride;
  const auto channels = static_cast<std::size_t>(row.channels);
  const float channel_weight = 3.0F / static_cast<float>(channels);
  const float k = row.position;
  for (std::size_t x = 0; x < static_cast<std::size_t>(row.width); ++x)
  {
    const Sample sample = sampleView(row, static_cast<int>(x));
    Values r{};
    float residual = 0.0F;
    for (std::size_t c = 0; c < channels; ++c)
    {
      r[c] = sample.value[c] - static_cast<float>(row.reference[c * row.reference_stride + x]);
      residual = residual + std::abs(r[c]);
    }
    residual = residual * channel_weight;
    const float weight = channel_weight / (residual + RESIDUAL_SOFTENING);
    float* const moments = row.moments + x;
    moments[MOMENT_RESIDUAL * width] += residual;
    moments[MOMENT_KK * width] += weight * (k * k);
    float gg = 0.0F;
    float gr = 0.0F;
    for (std::size_t c = 0; c < channels; ++c)
    {
      const float g = sample.slope[c];
      gg = gg + g * g;
      gr = gr + g * r[c];
      moments[(MOMENT_KG + c) * width] += weight * k * g;
      moments[(MOMENT_KR + c) * width] += weight * k * r[c];
    }
    moments[MOMENT_GG * width] += weight * gg;
    moments[MOMENT_GR * width] += weight * gr;
  }
}

}  // namespace light_field_depth::multiview
