#ifndef LIGHT_FIELD_DEPTH_CORE_VIEW_LAYOUT_H
#define LIGHT_FIELD_DEPTH_CORE_VIEW_LAYOUT_H

#include <vector>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// One of the eight ways to lay a grid over the same images: the numbers of rows or columns run backwards,
/// then they have changed roles.
struct GridSymmetry
{
  bool rows_reversed = false;     ///< the first row is the last
  bool columns_reversed = false;  ///< the first column is the last
  bool transposed = false;        ///< then rows are columns
};

std::vector<GridSymmetry> allGridSymmetries();

/// The light field with its places numbered anew, each view with its image. The same reference view; numbers
/// may become negative. Calibration is kept.
LightField relabelled(const LightField& light_field, const GridSymmetry& symmetry);

/// How the claimed places of the views have to be changed before the images agree with them. Of the eight
/// ways to lay a grid over the images four can be told apart by matching: the other four differ from them by
/// the sign of the disparity.
struct GridLayout
{
  /// Rows and columns have changed roles.
  bool transposed = false;
  /// Then, one of the two axes runs backwards; which one is the question of the sign.
  bool mirrored = false;
};

inline bool operator==(const GridLayout& a, const GridLayout& b)
{
  return a.transposed == b.transposed && a.mirrored == b.mirrored;
}

/// When findLayout() decides. Measured by `bench --order`.
struct LayoutOptions
{
  /// Mean cost of the second best layout over that of the best one. Lower it, and repeated texture decides.
  double min_ratio = 1.05;
  /// The same where views at the same or a larger distance ask for another layout, as fine stripes do.
  double min_contradicted_ratio = 1.3;
  /// The same difference in terms of its spread over 5 x 5 parts of the image.
  double min_significance = 3.5;
  /// The best layout's cost over that of a displacement at random: the images must match at all.
  double max_match = 0.5;
};

/// What the images say of the layout.
struct FoundLayout
{
  /// False: the images do not tell, and `layout` is only the likeliest one.
  bool decided = false;
  GridLayout layout;          ///< the cheapest one
  double ratio = 1.0;         ///< see LayoutOptions::min_ratio; at least 1
  double significance = 0.0;  ///< see LayoutOptions::min_significance
  double match = 1.0;         ///< see LayoutOptions::max_match; 0 for a perfect match
};

/// Finds by the images whether the rows and columns of a light field have been taken for each other, and
/// whether one of them runs backwards.
///
/// In each of the layouts the views on the row and on the column of the reference must be explained by one
/// disparity a pixel. The local contrast of reduced views is compared at all displacements along both axes,
/// with views at three distances from the reference, and the layout with the smallest cost wins. Of a single
/// row (or column) only the direction can be told, so that `mirrored` is false.
///
/// 20 ms for 17 views of 512 x 512 pixels on one thread.
/// @param light_field of any type
/// @return undecided where the reference has no other view on its row and its column
FoundLayout findLayout(const LightField& light_field, ThreadPool& pool, const LayoutOptions& options = {});

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_VIEW_LAYOUT_H
