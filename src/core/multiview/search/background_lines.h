#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_BACKGROUND_LINES_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_BACKGROUND_LINES_H

#include "core/multiview/search/background_kernels.h"
#include "core/multiview/search/cost_volume.h"

namespace light_field_depth::multiview
{
/// Side of the blocks that have a floor each.
constexpr int BLOCK_PX = 2 * TILE_PX;

/// The row y of the tile in a column of tiles; clear where there is none.
inline TileLine lineAt(const CostVolume& volume, int tile_column, int y)
{
  if (tile_column < 0 || tile_column >= volume.bands.columns() || y < 0 || y >= volume.height)
  {
    return {};
  }
  const LabelBand& band = volume.bands.at(y / TILE_PX, tile_column);
  return {volume.values.data() + volume.index(tile_column * TILE_PX, y, band.first), band};
}

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_BACKGROUND_LINES_H
