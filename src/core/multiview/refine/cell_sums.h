#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_CELL_SUMS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_CELL_SUMS_H

#include <cstddef>
#include <vector>

namespace light_field_depth::multiview
{
/// Side of the square cells of a map in which sums over its pixels are kept.
constexpr int CELL_PX = 4;

/// Cells that it takes to cover so many pixels.
constexpr int cellCount(int pixels)
{
  return (pixels + CELL_PX - 1) / CELL_PX;
}

/// Adds the sums over the rows of a row of cells, a column each, to the cells.
/// @param cells [cellCount(columns)]
inline void joinColumns(const std::vector<float>& columns, float* cells)
{
  for (std::size_t x = 0; x < columns.size(); ++x)
  {
    cells[x / CELL_PX] += columns[x];
  }
}

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_CELL_SUMS_H
