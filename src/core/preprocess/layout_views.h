#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_LAYOUT_VIEWS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_LAYOUT_VIEWS_H

#include <cstddef>
#include <vector>

#include "core/preprocess/axis_sweep.h"
#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// One or two views on the claimed row or column of the reference, on opposite sides where there are two.
struct LineViews
{
  std::vector<std::size_t> indices;  ///< into LightField::views
  std::vector<float> units;          ///< their steps along the line, over the distance asked for
};

/// The views on the row (or column) of the reference that stand about `distance` grid steps from it.
/// @return empty if there is none
LineViews viewsOnLine(const LightField& light_field, bool row, int distance);

/// Distances from the reference, in grid steps, at which both lines have views, where both exist: 1, a
/// quarter and a half of the extent. Empty if neither line has views.
std::vector<int> layoutDistances(const LightField& light_field);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_LAYOUT_VIEWS_H
