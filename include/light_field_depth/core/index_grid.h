#ifndef LIGHT_FIELD_DEPTH_CORE_INDEX_GRID_H
#define LIGHT_FIELD_DEPTH_CORE_INDEX_GRID_H

#include <vector>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// When findRunLength() decides. Measured on eight captures and rendered light fields of 3 x 3 to 17 x 17
/// views, their rows, and their views numbered back and forth.
struct IndexGridOptions
{
  /// Difference of views one run apart over that of views one more or one less apart. Of 0.99 to 1.09 where
  /// there are no runs; a grid's lies between 0.3 and 0.75.
  double max_dip = 0.80;
  /// Difference of views that face each other across the end of a run over that of views as many numbers
  /// apart. Of 0.22 to 0.61 where every second run goes backwards, otherwise 0.82 or more.
  double max_fold = 0.70;
  /// Views are one single row if all dips and folds are at least so large, ...
  double min_of_row = 0.92;
  /// ... and the difference of views two numbers apart over that of neighbours is, too: a row's is 1.27
  /// to 1.98, that of views that all look alike 1.
  double min_growth_of_row = 1.20;
};

/// The shape of a grid whose views are numbered one after the other.
struct RunLength
{
  /// Views in a row (or in a column, if the numbers run down the columns); all of them if they are a single
  /// row; 0 if the images do not tell.
  int length = 0;
  bool alternating = false;  ///< every second run is numbered backwards
  double dip = 1.0;          ///< see IndexGridOptions::max_dip; of the best length
  double fold = 1.0;         ///< see IndexGridOptions::max_fold; of the best length
  /// Place of the first view in its run: not 0 if the views before it are missing.
  int first_place = 0;
};

/// How many thumbnails findRunLength() needs of so many views: the first ones. All runs but very long ones
/// show in them.
int thumbnailsForRunLength(int views);

/// A small grey image of a view. @param view of 8 or 16 bits, grey or colour
cv::Mat thumbnailOf(const cv::Mat& view);

/// Finds after how many views the next row begins: views above each other look more alike than those beside
/// them. Where every second row is numbered backwards, those look alike that are as far before the end of a
/// row as behind it.
/// @param thumbnails of the first views in the order of their numbers, all of one size
/// @param views in all; the length divides it
RunLength findRunLength(const std::vector<cv::Mat>& thumbnails, int views,
                        const IndexGridOptions& options = {});

/// The same where views are missing, so that any length may be right, and the first view may stand inside of
/// its run. Does not look for runs that are numbered backwards.
/// @param thumbnails empty for numbers without a view
/// @param views from the first number to the last
/// @param max_missing_before the most views that may be missing before the first one
RunLength findRunLengthWithGaps(const std::vector<cv::Mat>& thumbnails, int views, int max_missing_before,
                                const IndexGridOptions& options = {});

/// A square of which nothing but corner views is missing, as plenoptic cameras leave them dark: its side, and
/// how many views are missing before the first one (0 or 1).
struct SquareWithoutCorners
{
  int side = 0;            ///< 0: it is none
  int missing_before = 0;  ///< views before the first one
};

/// @param present from the first view to the last: whether there is a view of this number; at least one
///   inside is missing
SquareWithoutCorners findSquareWithoutCorners(const std::vector<bool>& present, int max_missing_before);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_INDEX_GRID_H
