#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_ANGULAR_VOLUME_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_ANGULAR_VOLUME_H

#include <cstddef>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/paper2017_options.h"

namespace light_field_depth
{
/// A spatio-angular volume (paper, 3.1): the views of one line of the grid, in the order of their positions.
/// The views need not stand at equal distances: where some are missing, neighbours are further apart.
struct AngularVolume
{
  std::string name;                       ///< "row_4", "column_4", ..., usable in a file name
  std::vector<std::size_t> view_indices;  ///< into LightField::views; at least two, no view twice
};

/// Auto and Cross give the row and the column of the reference view, Row and Column one of them, Star also
/// both diagonals, All every row and every column. A line with fewer than two views is left out. When named
/// rows or columns are given, exactly those are used. When no line has two views, each view makes a volume
/// with the reference view.
/// @pre validate(options) is empty
/// @throw InputError for a named row or column in which fewer than two views stand
std::vector<AngularVolume> extractVolumes(const LightField& light_field, ViewSelection selection,
                                          const AngularVolumeOptions& options = {});

/// How the pixels of one view move to another: what a scene point of disparity d does is
///   p_to = p_from - d * steps + offset_px
struct ViewPair
{
  cv::Point2d steps;      ///< in grid steps
  cv::Point2d offset_px;  ///< what no disparity explains
};

ViewPair pairOf(const View& from, const View& to);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_ANGULAR_VOLUME_H
