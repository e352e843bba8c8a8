#ifndef LIGHT_FIELD_DEPTH_CORE_INDEX_GRID_H
#define LIGHT_FIELD_DEPTH_CORE_INDEX_GRID_H

#include <vector>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// When findRunLength() decides.
struct IndexGridOptions
{
  /// Difference of views one run apart over that of views one more or one less apart. Of 1 where there are no
  /// runs; a grid's lies between 0.3 and 0.75.
  double max_dip = 0.80;
};

/// The shape of a grid whose views are numbered one after the other.
struct RunLength
{
  /// Views in a row (or in a column, if the numbers run down the columns); 0 if the images do not tell.
  int length = 0;
  double dip = 1.0;  ///< see IndexGridOptions::max_dip; of the best length
};

/// How many thumbnails findRunLength() needs of so many views: the first ones. All runs but very long ones
/// show in them.
int thumbnailsForRunLength(int views);

/// A small grey image of a view. @param view of 8 or 16 bits, grey or colour
cv::Mat thumbnailOf(const cv::Mat& view);

/// Finds after how many views the next row begins: views above each other look more alike than those beside
/// them.
/// @param thumbnails of the first views in the order of their numbers, all of one size
/// @param views in all; the length divides it
RunLength findRunLength(const std::vector<cv::Mat>& thumbnails, int views,
                        const IndexGridOptions& options = {});

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_INDEX_GRID_H
