#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_FUSION_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_FUSION_H

#include <cstdint>
#include <functional>
#include <vector>

#include "core/cloud/surface_map.h"
#include "core/cloud/surface_warp.h"
#include "light_field_depth/core/light_field.h"

namespace light_field_depth::cloud
{
/// What the maps agree on in a row of a view.
struct FusedRow
{
  std::vector<float> disparity;        ///< NaN where nothing is kept
  std::vector<float> confidence;       ///< 0..1
  std::vector<float> slope_x;          ///< of the surface's plane in the pixel grid of the view
  std::vector<float> slope_y;          ///< likewise
  std::vector<std::uint8_t> votes;     ///< maps that agree
  std::vector<std::uint8_t> by_first;  ///< 1 where the first map is one of them
};

/// Receives the rows of a view in their order.
using FusedRowSink = std::function<void(int y, const FusedRow& row)>;

/// What fusing one view needs besides the maps; one for each thread.
struct FusionScratch
{
  std::vector<SurfaceWarp> warps;
  FusedRow row;
};

/// Brings all maps to a view, takes the best supported of their surfaces at each pixel, and drops what too
/// few maps support or what a map sees through. Where nothing is left and a plane holds what a map of this
/// very view has, that is taken.
/// @param maps one to MAX_FUSED_MAPS
/// @param min_confidence 0..1
void fuseView(const std::vector<SurfaceMap>& maps, const View& view, const Tolerance& tolerance,
              float min_confidence, FusionScratch& scratch, const FusedRowSink& sink);

}  // namespace light_field_depth::cloud

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_FUSION_H
