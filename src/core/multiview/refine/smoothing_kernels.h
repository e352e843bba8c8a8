#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_SMOOTHING_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_SMOOTHING_KERNELS_H

#include <cstddef>
#include <cstdint>

namespace light_field_depth::multiview
{
/// Loops of the edge-aware smoothing (edge_aware_smoothing.h). Every kernel has a plain version that computes
/// the same values bit for bit.

/// Keeps the system regular where nothing is known, and is no say there: links are a thousand times as strong
/// even across a change of colour and disparity.
constexpr float TINY_WEIGHT = 1e-5F;

/// Rows that are solved side by side, a multiple of every vector.
constexpr int ROWS_AT_ONCE = 32;

/// The links of a row of the disparity: link = guide * flat / sqrt((change - slope)^2 + flat^2).
struct LinkRow
{
  const float* guide_left = nullptr;   ///< [width]
  const float* guide_above = nullptr;  ///< [width]
  const float* disparity = nullptr;    ///< [width]
  const float* above = nullptr;        ///< the row above, the same row in the first one
  const float* slope_left = nullptr;   ///< [width], changes that cost nothing
  const float* slope_above = nullptr;  ///< [width]
  int width = 0;
  float flat_px = 0.0F;
  float* left = nullptr;  ///< [width + 1], result: 0 at both ends
  float* up = nullptr;    ///< [width], result
};

void linkRow(const LinkRow& row);
void linkRowPlain(const LinkRow& row);

/// A row of the system, given the rows above and below.
struct SystemRow
{
  const float* weight = nullptr;
  const float* target = nullptr;
  const float* left = nullptr;   ///< [width + 1], 0 at both ends
  const float* up = nullptr;     ///< 0 in the first row
  const float* down = nullptr;   ///< 0 in the last row
  const float* above = nullptr;  ///< values of the row above; any where up is 0
  const float* below = nullptr;
  float* values = nullptr;  ///< result; may be the values of the row above or below where those do not count
};

/// Floats that solveRows() works in.
constexpr std::size_t rowScratch(int width)
{
  return 2 * static_cast<std::size_t>(ROWS_AT_ONCE) * static_cast<std::size_t>(width);
}

/// Solves up to ROWS_AT_ONCE rows exactly, each given the rows above and below it.
/// @pre no row of the results is read for another one
/// @param scratch [rowScratch(width)]
void solveRows(const SystemRow* rows, int count, int width, float* scratch);
void solveRowsPlain(const SystemRow* rows, int count, int width, float* scratch);

/// One row of the elimination along columns first .. last - 1, given the columns beside each.
struct ColumnStep
{
  const float* weight = nullptr;
  const float* target = nullptr;
  const float* left = nullptr;  ///< [width + 1], 0 at both ends
  const float* up = nullptr;
  const float* down = nullptr;
  const float* disparity = nullptr;  ///< of the whole row
  int first = 0;
  int last = 0;
  int width = 0;
  const float* factor_above = nullptr;  ///< [last - first], of the row above
  const float* value_above = nullptr;
  float* factor = nullptr;  ///< x = value + factor * (the unknown below)
  float* value = nullptr;
};

void eliminateColumns(const ColumnStep& step);
void eliminateColumnsPlain(const ColumnStep& step);

/// solution = value + factor * below
void substituteColumns(const float* value, const float* factor, const float* below, int count,
                       float* solution);
void substituteColumnsPlain(const float* value, const float* factor, const float* below, int count,
                            float* solution);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_SMOOTHING_KERNELS_H
