#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_ARRAY_BASELINE_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_ARRAY_BASELINE_H

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// Metres from a view to the next one: the median over neighbours in a row, in a column where no row has two
/// views. Neighbours may be more than one step of the grid apart.
/// @param grid       places of the views
/// @param positions  of their cameras, in metres to the right and downwards
/// @throw InputError for two neighbours in the wrong order, or if no two views share a row or a column
double adjacentBaseline(const std::vector<GridPosition>& grid, const std::vector<cv::Point2d>& positions);

/// The same from a row to the next one; nothing where no column has two views. @throw InputError
std::optional<double> rowBaseline(const std::vector<GridPosition>& grid,
                                  const std::vector<cv::Point2d>& positions);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_ARRAY_BASELINE_H
