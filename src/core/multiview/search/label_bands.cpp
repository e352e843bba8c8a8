#include "core/multiview/search/label_bands.h"

#include <algorithm>
#include <cmath>

namespace light_field_depth::multiview
{
namespace
{
/// Rows of tiles of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int TILE_ROWS_PER_CHUNK = 2;

/// Smallest and largest value of a part of a map.
struct Extent
{
  float low = 0.0F;
  float high = 0.0F;
};

Extent extentOf(const cv::Mat& disparity, const cv::Rect& area)
{
  Extent extent{disparity.at<float>(area.tl()), disparity.at<float>(area.tl())};
  for (int y = area.y; y < area.y + area.height; ++y)
  {
    const auto* const row = disparity.ptr<float>(y);
    for (int x = area.x; x < area.x + area.width; ++x)
    {
      extent.low = std::min(extent.low, row[x]);
      extent.high = std::max(extent.high, row[x]);
    }
  }
  return extent;
}

}  // namespace

void LabelBands::setAll(int width, int height, int labels)
{
  columns_ = (width + TILE_PX - 1) / TILE_PX;
  rows_ = (height + TILE_PX - 1) / TILE_PX;
  labels_ = labels;
  bands_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), {0, labels});
}

void LabelBands::setAround(const cv::Mat& disparity, const LabelSpace& space, int reach_px, float margin,
                           ThreadPool& pool)
{
  setAll(disparity.cols, disparity.rows, space.count);
  const cv::Rect whole(0, 0, disparity.cols, disparity.rows);
  pool.parallelFor(
      0, rows_, TILE_ROWS_PER_CHUNK,
      [&](int first_row, int last_row)
      {
        for (int row = first_row; row < last_row; ++row)
        {
          for (int column = 0; column < columns_; ++column)
          {
            const int side = TILE_PX + 2 * reach_px;
            const cv::Rect area(column * TILE_PX - reach_px, row * TILE_PX - reach_px, side, side);
            const Extent extent = extentOf(disparity, area & whole);
            const int first = std::clamp(static_cast<int>(std::floor(space.label(extent.low) - margin)), 0,
                                         space.count - 1);
            const int last = std::clamp(static_cast<int>(std::ceil(space.label(extent.high) + margin)), first,
                                        space.count - 1);
            at(row, column) = {first, last - first + 1};
          }
        }
      });
}

}  // namespace light_field_depth::multiview
