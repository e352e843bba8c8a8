#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_NORMAL_EQUATION_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_NORMAL_EQUATION_KERNELS_H

#include <cstddef>

namespace light_field_depth::multiview
{
/// What is summed over the rays of a pair of opposite arms, a row of numbers each: g is the derivative of
/// a view's brightness by the disparity, the rest is that of the rays (linearize_kernels.h). KG and KR have
/// one row a channel.
constexpr std::size_t MOMENT_GG = 0;
constexpr std::size_t MOMENT_GR = 1;  ///< sums of products, as the names say
constexpr std::size_t MOMENT_KK = 2;
constexpr std::size_t MOMENT_KG = 3;
constexpr std::size_t momentKr(int channels)
{
  return MOMENT_KG + static_cast<std::size_t>(channels);
}
constexpr std::size_t momentCount(int channels)
{
  return momentKr(channels) + static_cast<std::size_t>(channels);
}

/// A row of the refocused mean with the rows two above to two below; each readable two pixels beyond its
/// ends.
struct DerivativeRow
{
  const float* rows[5] = {};
  int width = 0;
  float* along_x = nullptr;
  float* along_y = nullptr;
};

/// One ray at one row.
struct RayRow
{
  const float* moments = nullptr;  ///< [RAY_MOMENTS][stride]
  const float* share = nullptr;    ///< [width], with which its arm counts
  const float* along_x = nullptr;  ///< [channels][stride], derivatives of the refocused mean
  const float* along_y = nullptr;
  float direction_x = 0.0F;  ///< steps of a view divided by its position
  float direction_y = 0.0F;
  int channels = 3;
  int width = 0;
  std::size_t stride = 0;
};

/// The normal equations of one pair of arms at one row, summed over a window.
struct PairRow
{
  const float* moments = nullptr;  ///< [momentCount(channels)][stride]
  bool brightness_slope = true;
  int channels = 3;
  int width = 0;
  std::size_t stride = 0;
};

/// Sums over the pairs, [stride] each.
struct SolutionRow
{
  float* curvature = nullptr;
  float* gradient = nullptr;
  float* disagreement = nullptr;
  float* positions = nullptr;  ///< sum of MOMENT_KK
};

/// How the sums over the pairs become the result.
struct FinalRow
{
  const float* disparity = nullptr;  ///< [stride], about which the views were linearised
  float window = 25.0F;              ///< pixels of the window
  float max_step_px = 0.15F;
  /// [stride], what noise adds to the curvature, in parts of the sum of MOMENT_KK.
  const float* slope_noise = nullptr;
  int width = 0;
};

/// The loops over the pixels of a row. Rows of [stride] numbers are read and written up to a multiple of 16
/// beyond the width. One source is compiled for every instruction set and no sum is reordered, so that all
/// processors give the same bits.

/// sums[i] = rows[0][i] + rows[1][i] + ...
void sumRows(const float* const* rows, int row_count, std::size_t count, float* sums);
/// out[x] = sum of in over `radius` pixels left and right, the ends repeated.
void boxRow(const float* in, int width, int radius, float* out);
/// values = values * factor + offset; lowest = min(lowest, values)
void scaleAndLower(float factor, float offset, int width, float* values, float* lowest);
/// values = (lowest / values)^4
void shareOfArm(const float* lowest, int width, float* values);
/// By differences of four pixels.
void differentiate(const DerivativeRow& row);
/// Adds a ray to the moments [momentCount(channels)][stride] of its pair.
void addRay(const RayRow& ray, float* pair);
/// Eliminates the slope of the brightness and adds the pair to the solution.
void addPair(const PairRow& pair, const SolutionRow& solution);
/// Turns the sums over the pairs into the curvature a pixel of the window, the disparity of the minimum, how
/// far apart the pairs' own minima lie, px, and what noise adds to the curvature a pixel, in place.
void solveRow(const FinalRow& row, const SolutionRow& solution);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_NORMAL_EQUATION_KERNELS_H
