#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_WINDOW_EXTENT_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_WINDOW_EXTENT_KERNELS_H

#include <cstddef>

#include <opencv2/core.hpp>

namespace light_field_depth::multiview
{
/// A row of a map with the rows about it.
struct ExtentRow
{
  static constexpr int MAX_RADIUS = 2;  // of the windows that the confidence looks at

  const float* rows[2 * MAX_RADIUS + 1] = {};  ///< 2 * radius + 1 of [width]
  int radius = 1;                              ///< 1 .. MAX_RADIUS
  int width = 0;
  float* columns = nullptr;  ///< scratch, [extentScratch(width)]
  float* low = nullptr;      ///< [width], results
  float* high = nullptr;
};

constexpr std::size_t extentScratch(int width)
{
  return 2 * static_cast<std::size_t>(width + 2 * ExtentRow::MAX_RADIUS);
}

/// The row y of a map, the borders repeated, without scratch and results.
/// @param map CV_32FC1
ExtentRow extentRowOf(const cv::Mat& map, int y, int radius);

/// Least and largest value in the window about each pixel, the row's ends repeated. The plain version
/// computes the same values.
void findExtents(const ExtentRow& row);
void findExtentsPlain(const ExtentRow& row);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_WINDOW_EXTENT_KERNELS_H
