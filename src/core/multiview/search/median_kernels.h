#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_MEDIAN_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_MEDIAN_KERNELS_H

#include <array>
#include <cstddef>

namespace light_field_depth::multiview
{
/// Side of the window.
constexpr int MEDIAN_SIZE = 5;

/// One row and those about it.
struct MedianRow
{
  std::array<const float*, MEDIAN_SIZE> rows{};  ///< [width] each; finite
  int width = 0;
  float scale = 1.0F;  ///< positive
  float offset = 0.0F;
  float* sorted_columns = nullptr;  ///< scratch, [medianScratch(width)]
  float* medians = nullptr;         ///< [width], result
};

constexpr std::size_t medianScratch(int width)
{
  return static_cast<std::size_t>(MEDIAN_SIZE) * static_cast<std::size_t>(width + MEDIAN_SIZE - 1);
}

/// medians = scale * the median over MEDIAN_SIZE x MEDIAN_SIZE values, the row's ends repeated, + offset. The
/// plain version computes the same values bit for bit.
void medianRow(const MedianRow& row);
void medianRowPlain(const MedianRow& row);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_MEDIAN_KERNELS_H
