#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_COARSE_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_COARSE_KERNELS_H

#include "core/multiview/refine/smoothing_kernels.h"

namespace light_field_depth::multiview
{
/// Loops between a grid of unknowns and one of half its side (coarse_correction.h). Every kernel has a plain
/// version that computes the same values bit for bit.

/// Part of the links between two cells that the coarse grid keeps. Cells that move as one bridge a step that
/// the links would spread over two pixels: all of it would be twice too stiff.
constexpr float COARSE_LINK = 0.5F;

/// Of the one or two rows of the fine grid that make a row of cells; [width] each.
struct CellSums
{
  float* weight = nullptr;
  float* residual = nullptr;
  float* left = nullptr;
};

/// What a row of the system still asks for: residual = w (t - v) + sum of s (v of a neighbour - v), with w
/// and the links to the left.
/// @param add to the sums; they are overwritten otherwise
void sumResiduals(const SystemRow& row, int width, bool add, const CellSums& sums);
void sumResidualsPlain(const SystemRow& row, int width, bool add, const CellSums& sums);

/// A row of cells as a row of the system of the coarse grid, whose unknown is the correction of all in a
/// cell.
struct CellRow
{
  CellSums sums;
  const float* up = nullptr;  ///< [width], links of the upper fine row
  int width = 0;              ///< of the fine grid; half of it, rounded up, is that of the coarse one
  float* weight = nullptr;
  float* target = nullptr;
  float* left = nullptr;  ///< [coarse width + 1], 0 at both ends
  float* coarse_up = nullptr;
};

void joinCells(const CellRow& row);
void joinCellsPlain(const CellRow& row);

/// fine[x] += factor * coarse[x / 2]
void spreadRow(const float* coarse, float factor, int width, float* fine);
void spreadRowPlain(const float* coarse, float factor, int width, float* fine);

/// Adds, column by column, what decides how far to go along the correction e, a row of SystemRow::values:
/// gain += w t e,  charge += w e^2 + sum of the fine grid's links (change of e)^2.
void sumGains(const SystemRow& row, int width, float* gain, float* charge);
void sumGainsPlain(const SystemRow& row, int width, float* gain, float* charge);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_COARSE_KERNELS_H
