#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_VISIBILITY_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_VISIBILITY_KERNELS_H

#include <cmath>
#include <cstdint>

namespace light_field_depth::multiview
{
/// One row of a disparity map on its way into a view of the same size.
struct WarpRow
{
  const float* disparity = nullptr;  ///< [width]
  int width = 0;
  int height = 0;
  float step_x = 0.0F;  ///< pixel x is seen at floor(x + base_x - disparity * step_x)
  float step_y = 0.0F;  ///< in row floor(base_y - disparity * step_y)
  float base_x = 0.0F;
  float base_y = 0.0F;
  int pitch = 0;  ///< from row to row of the view
  int first = 0;  ///< index of the view's pixel (0, 0)
};

/// Where the view sees pixel x: first + row * pitch + column, or 0 where it does not.
inline std::int32_t warpTarget(const WarpRow& row, int x)
{
  const float disparity = row.disparity[x];
  const auto target_x =
      static_cast<int>(std::floor(static_cast<float>(x) + row.base_x - disparity * row.step_x));
  const auto target_y = static_cast<int>(std::floor(row.base_y - disparity * row.step_y));
  const bool inside = target_x >= 0 && target_x < row.width && target_y >= 0 && target_y < row.height;
  return inside ? target_y * row.pitch + target_x + row.first : 0;
}

/// warpTarget() of every pixel. The plain version computes the same values.
/// @param targets [width]
void warpTargets(const WarpRow& row, std::int32_t* targets);
void warpTargetsPlain(const WarpRow& row, std::int32_t* targets);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_VISIBILITY_KERNELS_H
