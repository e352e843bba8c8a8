#ifndef LIGHT_FIELD_DEPTH_SRC_IO_VIEW_PLACEMENT_H
#define LIGHT_FIELD_DEPTH_SRC_IO_VIEW_PLACEMENT_H

#include <filesystem>
#include <vector>

#include "io/dataset_layout.h"
#include "io/folder_description.h"

namespace light_field_depth
{
/// Where the views of a dataset stand, in this package's convention.
struct PlacedViews
{
  std::vector<View> views;      ///< without images, row-major; FolderDescription::views has the same order
  GridPosition reference;       ///< as View::grid counts
  cv::Point2d reference_steps;  ///< from the dataset's own reference view to the chosen one
  double step_m = 0.0;          ///< metres of one step, where the positions tell
  bool own_reference = true;    ///< the chosen one is the dataset's own
  Flip flip = Flip::None;       ///< that was applied
  bool own_layout = true;       ///< the dataset says the same, flip and order
};

/// Turns numbers and positions into View::grid and View::steps, and sorts the views. Numbers, positions, grid
/// and reference of the description change their rows for columns where the layout's order differs.
/// @param wanted_reference numbered as in the files, the row first
/// @throw InputError if a place is taken twice, the reference is not there or the positions make no grid
PlacedViews placeViews(const std::filesystem::path& folder, FolderDescription& description,
                       const Layout& layout, const std::optional<GridPosition>& wanted_reference);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_VIEW_PLACEMENT_H
