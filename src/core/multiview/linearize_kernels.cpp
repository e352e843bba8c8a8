// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "multiview/linearize_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "light_field_depth/core/multiview/cubic_taps.h"
#include "light_field_depth/core/multiview/linearize_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
#if HWY_TARGET == HWY_SCALAR
// A processor without any of the known vector instructions.
void linearizeRowSimd(const LinearizeRow& row)
{
  linearizeRowPlain(row);
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
  FloatVector value0, value1, value2, value3;
  FloatVector slope0, slope1, slope2, slope3;
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
  const auto t_nine_halves = hn::Mul(t, c(4.5F));
  Axis axis;
  axis.first = hn::Sub(hn::ConvertTo(i, whole), hn::Set(i, 1));
  axis.value0 = hn::Mul(hn::Sub(hn::Mul(hn::Sub(c(1.0F), t_half), t), c(0.5F)), t);
  axis.value1 = hn::Add(hn::Mul(hn::Mul(hn::Sub(t_three_halves, c(2.5F)), t), t), c(1.0F));
  axis.value2 = hn::Mul(hn::Add(hn::Mul(hn::Sub(c(2.0F), t_three_halves), t), c(0.5F)), t);
  axis.value3 = hn::Mul(hn::Mul(hn::Sub(t_half, c(0.5F)), t), t);
  axis.slope0 = hn::Sub(hn::Mul(hn::Sub(c(2.0F), t_three_halves), t), c(0.5F));
  axis.slope1 = hn::Mul(hn::Sub(t_nine_halves, c(5.0F)), t);
  axis.slope2 = hn::Add(hn::Mul(hn::Sub(c(4.0F), t_nine_halves), t), c(0.5F));
  axis.slope3 = hn::Mul(hn::Sub(t_three_halves, c(1.0F)), t);
  return axis;
}

/// Value and slope of up to three channels.
struct Sample
{
  FloatVector value0, value1, value2;
  FloatVector slope0, slope1, slope2;
};

HWY_INLINE Sample zeroSample()
{
  const auto zero = hn::Zero(Floats());
  return {zero, zero, zero, zero, zero, zero};
}

template <int CHANNEL>
HWY_INLINE FloatVector channelOf(IntegerVector pixel)
{
  const Integers i;
  return hn::ConvertTo(Floats(), hn::And(hn::ShiftRight<8 * CHANNEL>(pixel), hn::Set(i, 255)));
}

template <int CHANNELS>
HWY_INLINE void addTap(IntegerVector pixel, FloatVector value, FloatVector slope, Sample& sample)
{
  const auto first = channelOf<0>(pixel);
  sample.value0 = hn::Add(sample.value0, hn::Mul(value, first));
  sample.slope0 = hn::Add(sample.slope0, hn::Mul(slope, first));
  if (CHANNELS == 3)
  {
    const auto second = channelOf<1>(pixel);
    const auto third = channelOf<2>(pixel);
    sample.value1 = hn::Add(sample.value1, hn::Mul(value, second));
    sample.slope1 = hn::Add(sample.slope1, hn::Mul(slope, second));
    sample.value2 = hn::Add(sample.value2, hn::Mul(value, third));
    sample.slope2 = hn::Add(sample.slope2, hn::Mul(slope, third));
  }
}

HWY_INLINE IntegerVector clampedIndex(IntegerVector index, int offset, int count)
{
  const Integers i;
  return hn::Min(hn::Max(hn::Add(index, hn::Set(i, offset)), hn::Zero(i)), hn::Set(i, count - 1));
}

template <int CHANNELS>
HWY_INLINE Sample sampleLine(const LinearizeRow& row, const Axis& axis, int count, int stride,
                             IntegerVector offset)
{
  const Integers i;
  const auto* const pixels = reinterpret_cast<const std::int32_t*>(row.pixels);
  const auto stride_vector = hn::Set(i, stride);
  const auto gather = [&](int tap) HWY_ATTR
  {
    const auto index = clampedIndex(axis.first, tap, count);
    return hn::GatherOffset(i, pixels, hn::Add(offset, hn::Mul(index, stride_vector)));
  };
  Sample sample = zeroSample();
  addTap<CHANNELS>(gather(0), axis.value0, axis.slope0, sample);
  addTap<CHANNELS>(gather(1), axis.value1, axis.slope1, sample);
  addTap<CHANNELS>(gather(2), axis.value2, axis.slope2, sample);
  addTap<CHANNELS>(gather(3), axis.value3, axis.slope3, sample);
  return sample;
}

template <int CHANNELS>
HWY_INLINE Sample sampleAlong(const LinearizeRow& row, const Axis& axis, int count, int stride,
                              IntegerVector offset, float step)
{
  Sample sample = sampleLine<CHANNELS>(row, axis, count, stride, offset);
  const auto factor = hn::Set(Floats(), -step);
  sample.slope0 = hn::Mul(sample.slope0, factor);
  sample.slope1 = hn::Mul(sample.slope1, factor);
  sample.slope2 = hn::Mul(sample.slope2, factor);
  return sample;
}

/// sum + (value * slope_x * -step_x + slope * value_x * -step_y)
HWY_INLINE FloatVector addSlope(const LinearizeRow& row, FloatVector sum, FloatVector down_value,
                                FloatVector down_slope, FloatVector line_value, FloatVector line_slope)
{
  const Floats f;
  const auto along_x = hn::Mul(hn::Mul(down_value, line_slope), hn::Set(f, -row.step_x));
  const auto along_y = hn::Mul(hn::Mul(down_slope, line_value), hn::Set(f, -row.step_y));
  return hn::Add(sum, hn::Add(along_x, along_y));
}

template <int CHANNELS>
HWY_INLINE void addLine(const LinearizeRow& row, const Axis& across, const Axis& down, int tap,
                        FloatVector value, FloatVector slope, Sample& sample)
{
  const Integers i;
  const auto offset = hn::Mul(clampedIndex(down.first, tap, row.height), hn::Set(i, row.row_stride));
  const Sample line = sampleLine<CHANNELS>(row, across, row.width, row.pixel_stride, offset);
  sample.value0 = hn::Add(sample.value0, hn::Mul(value, line.value0));
  sample.slope0 = addSlope(row, sample.slope0, value, slope, line.value0, line.slope0);
  if (CHANNELS == 3)
  {
    sample.value1 = hn::Add(sample.value1, hn::Mul(value, line.value1));
    sample.slope1 = addSlope(row, sample.slope1, value, slope, line.value1, line.slope1);
    sample.value2 = hn::Add(sample.value2, hn::Mul(value, line.value2));
    sample.slope2 = addSlope(row, sample.slope2, value, slope, line.value2, line.slope2);
  }
}

template <int CHANNELS>
HWY_INLINE Sample sampleView(const LinearizeRow& row, FloatVector x, FloatVector disparity)
{
  const Floats f;
  const Integers i;
  const auto position = [&](FloatVector start, float offset, float step) HWY_ATTR
  { return hn::Add(start, hn::Sub(hn::Set(f, offset), hn::Mul(disparity, hn::Set(f, step)))); };
  const auto at_x = position(x, row.offset_x, row.step_x);
  const auto at_y = position(hn::Set(f, static_cast<float>(row.y)), row.offset_y, row.step_y);
  if (row.step_y == 0.0F && row.offset_y == 0.0F)
  {
    return sampleAlong<CHANNELS>(row, axisAt(at_x), row.width, row.pixel_stride,
                                 hn::Set(i, row.y * row.row_stride), row.step_x);
  }
  if (row.step_x == 0.0F && row.offset_x == 0.0F)
  {
    const auto column = hn::Mul(hn::ConvertTo(i, x), hn::Set(i, row.pixel_stride));
    return sampleAlong<CHANNELS>(row, axisAt(at_y), row.height, row.row_stride, column, row.step_y);
  }
  const Axis across = axisAt(at_x);
  const Axis down = axisAt(at_y);
  Sample sample = zeroSample();
  addLine<CHANNELS>(row, across, down, 0, down.value0, down.slope0, sample);
  addLine<CHANNELS>(row, across, down, 1, down.value1, down.slope1, sample);
  addLine<CHANNELS>(row, across, down, 2, down.value2, down.slope2, sample);
  addLine<CHANNELS>(row, across, down, 3, down.value3, down.slope3, sample);
  return sample;
}

HWY_INLINE void addTo(float* sum, FloatVector value)
{
  const Floats f;
  hn::StoreU(hn::Add(hn::LoadU(f, sum), value), f, sum);
}

template <int CHANNELS>
HWY_INLINE void linearizePixels(const LinearizeRow& row, int x)
{
  const Floats f;
  const Integers i;
  const hn::Rebind<std::uint8_t, Floats> bytes;
  const std::size_t width = row.moment_stride;
  const auto columns =
      hn::Min(hn::Iota(f, static_cast<float>(x)), hn::Set(f, static_cast<float>(row.width - 1)));
  const Sample sample = sampleView<CHANNELS>(row, columns, hn::LoadU(f, row.disparity + x));
  const auto difference = [&](FloatVector value, std::size_t channel) HWY_ATTR
  {
    const auto pixels = hn::LoadU(bytes, row.reference + channel * row.reference_stride + x);
    return hn::Sub(value, hn::ConvertTo(f, hn::PromoteTo(i, pixels)));
  };
  const auto channel_weight = hn::Set(f, 3.0F / static_cast<float>(CHANNELS));
  const auto zero = hn::Zero(f);
  const auto r0 = difference(sample.value0, 0);
  const auto r1 = CHANNELS == 3 ? difference(sample.value1, 1) : zero;
  const auto r2 = CHANNELS == 3 ? difference(sample.value2, 2) : zero;
  const auto sum = hn::Add(hn::Add(hn::Abs(r0), hn::Abs(r1)), hn::Abs(r2));
  const auto residual = hn::Mul(sum, channel_weight);
  const auto weight = hn::Div(channel_weight, hn::Add(residual, hn::Set(f, RESIDUAL_SOFTENING)));
  const auto weight_k = hn::Mul(weight, hn::Set(f, row.position));
  float* const moments = row.moments + x;
  addTo(moments + MOMENT_RESIDUAL * width, residual);
  addTo(moments + MOMENT_KK * width, hn::Mul(weight, hn::Set(f, row.position * row.position)));
  auto gg = hn::Mul(sample.slope0, sample.slope0);
  auto gr = hn::Mul(sample.slope0, r0);
  addTo(moments + MOMENT_KG * width, hn::Mul(weight_k, sample.slope0));
  addTo(moments + MOMENT_KR * width, hn::Mul(weight_k, r0));
  if (CHANNELS == 3)
  {
    gg = hn::Add(hn::Add(gg, hn::Mul(sample.slope1, sample.slope1)), hn::Mul(sample.slope2, sample.slope2));
    gr = hn::Add(hn::Add(gr, hn::Mul(sample.slope1, r1)), hn::Mul(sample.slope2, r2));
    addTo(moments + (MOMENT_KG + 1) * width, hn::Mul(weight_k, sample.slope1));
    addTo(moments + (MOMENT_KG + 2) * width, hn::Mul(weight_k, sample.slope2));
    addTo(moments + (MOMENT_KR + 1) * width, hn::Mul(weight_k, r1));
    addTo(moments + (MOMENT_KR + 2) * width, hn::Mul(weight_k, r2));
  }
  addTo(moments + MOMENT_GG * width, hn::Mul(weight, gg));
  addTo(moments + MOMENT_GR * width, hn::Mul(weight, gr));
}

void linearizeRowSimd(const LinearizeRow& row)
{
  const int lanes = static_cast<int>(hn::Lanes(Floats()));
  for (int x = 0; x < row.width; x += lanes)
  {
    if (row.channels == 3)
    {
      linearizePixels<3>(row, x);
    }
    else
    {
      linearizePixels<1>(row, x);
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
HWY_EXPORT(linearizeRowSimd);

void linearizeRow(const LinearizeRow& row)
{
  HWY_DYNAMIC_DISPATCH(linearizeRowSimd)(row);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
