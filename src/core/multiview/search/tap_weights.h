#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_TAP_WEIGHTS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_TAP_WEIGHTS_H

#include <array>
#include <cstdint>

#include "core/multiview/search/sample_rows.h"

namespace light_field_depth::multiview
{
/// Interpolation weights are integers that add up to 2^TAP_SHIFT.
constexpr int TAP_SHIFT = 6;
constexpr int TAP_SCALE = 1 << TAP_SHIFT;

/// Catmull-Rom weights of the pixels -1, 0, 1, 2 for a point at `phase` / SUBPIXEL_PHASES between 0 and 1.
constexpr std::array<std::int16_t, 4> tapWeights(int phase)
{
  const double t = static_cast<double>(phase) / SUBPIXEL_PHASES;
  const auto fixed = [](double weight)
  { return static_cast<int>(weight * TAP_SCALE + (weight < 0.0 ? -0.5 : 0.5)); };
  const int before = fixed(-0.5 * t + t * t - 0.5 * t * t * t);
  const int right = fixed(0.5 * t + 2.0 * t * t - 1.5 * t * t * t);
  const int after = fixed(-0.5 * t * t + 0.5 * t * t * t);
  const int left = TAP_SCALE - before - right - after;
  return {static_cast<std::int16_t>(before), static_cast<std::int16_t>(left),
          static_cast<std::int16_t>(right), static_cast<std::int16_t>(after)};
}

constexpr std::array<std::array<std::int16_t, 4>, SUBPIXEL_PHASES> makeTapWeights()
{
  std::array<std::array<std::int16_t, 4>, SUBPIXEL_PHASES> weights{};
  for (int phase = 0; phase < SUBPIXEL_PHASES; ++phase)
  {
    weights[static_cast<std::size_t>(phase)] = tapWeights(phase);
  }
  return weights;
}

constexpr auto TAP_WEIGHTS = makeTapWeights();

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_TAP_WEIGHTS_H
