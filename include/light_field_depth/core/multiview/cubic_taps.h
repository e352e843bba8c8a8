#ifndef LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_CUBIC_TAPS_H
#define LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_CUBIC_TAPS_H

namespace light_field_depth::multiview
{
/// Added to the residual of a view before its weight is taken, 1 / (residual + this).
constexpr float RESIDUAL_SOFTENING = 2.0F;

/// Catmull-Rom weights of the pixels -1, 0, 1, 2 at 0 <= t < 1, in an order of operations that the
/// vector kernels repeat.
inline float cubicValue0(float t)
{
  return ((1.0F - t * 0.5F) * t - 0.5F) * t;
}
inline float cubicValue1(float t)
{
  return (t * 1.5F - 2.5F) * t * t + 1.0F;
}
inline float cubicValue2(float t)
{
  return ((2.0F - t * 1.5F) * t + 0.5F) * t;
}
inline float cubicValue3(float t)
{
  return (t * 0.5F - 0.5F) * t * t;
}

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_CUBIC_TAPS_H
