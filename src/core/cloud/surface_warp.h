#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_WARP_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_WARP_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/cloud/cloud_kernels.h"
#include "core/cloud/surface_map.h"
#include "light_field_depth/core/light_field.h"

namespace light_field_depth::cloud
{
/// A row of a view as a map shows it.
struct WarpedRow
{
  const std::int32_t* source = nullptr;  ///< index of the map's pixel; NOTHING_HERE where there is none
  const float* disparity = nullptr;      ///< resampled to the pixel's centre along the surface's plane

  static constexpr std::int32_t NOTHING_HERE = -1;
};

/// Brings the pixels of a map that take part to where a view sees them, the nearest surface in front, and of
/// one surface the pixel that falls nearest to the centre. Single gaps inside a surface are closed. Rows of
/// the view come in their order; only those that the map may still reach are in memory, so that all of it
/// stays near the processor. Memory is used again from view to view.
class SurfaceWarp
{
public:
  /// @param map, tolerance must live until the last row
  void begin(const SurfaceMap& map, const View& view, const Tolerance& tolerance);

  /// The next row of the view; valid until the next call but one.
  WarpedRow nextRow();

private:
  void finish(int line);
  void clearUpTo(int line);
  void bring(int row);
  void closeGaps(int line);
  void closeGap(std::size_t before, std::size_t here, std::size_t after);
  bool isBetter(std::int32_t target, std::int32_t source, float there) const;
  float distanceOf(std::int32_t source) const;
  std::size_t startOf(int line) const
  {
    return static_cast<std::size_t>(line & projected_.row_mask) * width_;
  }

  const SurfaceMap* map_ = nullptr;
  const Tolerance* tolerance_ = nullptr;
  ProjectedRow projected_;
  std::size_t width_ = 0;
  float begin_y_ = 0.0F;     ///< where disparity 0 brings row 0, plus half a pixel
  float least_rise_ = 0.0F;  ///< from a row of the map to the lines that its pixels fall on
  float most_rise_ = 0.0F;
  int next_line_ = 0;
  int next_row_ = 0;  ///< of the map
  int next_clear_ = 0;
  // A ring of lines of the view.
  std::vector<std::int32_t> source_;
  std::vector<float> disparity_;
  // Of a row of the map on its way.
  std::vector<std::int32_t> target_;
  std::vector<float> there_;
};

}  // namespace light_field_depth::cloud

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_SURFACE_WARP_H
