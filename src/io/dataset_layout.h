#ifndef LIGHT_FIELD_DEPTH_SRC_IO_DATASET_LAYOUT_H
#define LIGHT_FIELD_DEPTH_SRC_IO_DATASET_LAYOUT_H

#include "io/folder_description.h"
#include "io/view_store.h"

namespace light_field_depth
{
/// How the numbers of a dataset are turned into rows and columns. The order comes first: flipped rows are
/// rows after it.
struct Layout
{
  Order order = Order::RowMajor;
  std::optional<Flip> flip;  ///< as the description and the positions say if absent
  LayoutSource source = LayoutSource::Names;
};

/// Gives views with a single number (PlaceClaim::SingleNumber) their rows and columns, as if the number ran
/// along the rows. The shape of the grid is that of the options, of the description, or a guess.
/// Takes the notes and warnings into the description.
/// @throw InputError if the options contradict the number of views
void settleGrid(FolderDescription& description, const DatasetOptions& options, ViewStore& store);

/// The order and the flip of the views: those of the options where they are given, then those of a
/// description or of camera positions, then those that the images of the views on the row and the column of
/// the reference tell, and where they do not, those of the names. Where the images contradict what goes
/// before them, that is a warning. Takes the notes and warnings into the description.
Layout settleLayout(FolderDescription& description, const DatasetOptions& options, ViewStore& store);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_DATASET_LAYOUT_H
