#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_CUBIC_TAPS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_CUBIC_TAPS_H

#include <array>

namespace light_field_depth::multiview
{
/// Sub-pixel samples are fixed-point numbers of 1 / SAMPLE_UNIT of a grey value. Sixteen bits hold them,
/// their differences, and the sum of the absolute differences of three channels.
constexpr int SAMPLE_SHIFT = 6;
constexpr float SAMPLE_UNIT = 1 << SAMPLE_SHIFT;

/// The weights of the taps are numbers of 1 / TAP_ONE.
constexpr float TAP_ONE = 32768.0F;
constexpr int TAP_MOST = 32767;  // of 16 bits: a tap of one is one unit less

/// Product of two such numbers, or of one and a sample, to the nearest.
inline int mulFixed(int a, int b)
{
  constexpr int shift = 15;  // of TAP_ONE
  return (a * b + (1 << (shift - 1))) >> shift;
}

/// Catmull-Rom weights of the pixels -1, 0, 1, 2 at 0 <= t < 1, as the vector kernels compute them: -t u u /
/// 2 and -t t u / 2 outside, where u is 1 - t.
inline std::array<int, 4> cubicTaps(float t)
{
  const int along = static_cast<int>(t * TAP_ONE);
  const int back = TAP_MOST - along;
  const int both = mulFixed(along, back);
  const int before = mulFixed(both, back) >> 1;
  const int after = mulFixed(both, along) >> 1;
  return {-before, 2 * before + back - after, 2 * after + along - before, -after};
}

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_CUBIC_TAPS_H
