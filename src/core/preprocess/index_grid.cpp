#include "light_field_depth/core/index_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
namespace
{
constexpr int THUMBNAIL_SIDE_PX = 32;
/// Of the square root of the number of views: so many runs of a square grid are looked at.
constexpr double RUNS = 4.0;

/// Mean absolute difference of the views that stand `lag` numbers apart.
double differenceAt(const std::vector<cv::Mat>& thumbnails, int lag)
{
  double sum = 0.0;
  const int pairs = static_cast<int>(thumbnails.size()) - lag;
  for (int i = 0; i < pairs; ++i)
  {
    const int other = i + lag;
    const cv::Mat& a = thumbnails[static_cast<std::size_t>(i)];
    const cv::Mat& b = thumbnails[static_cast<std::size_t>(other)];
    sum += cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total());
  }
  return pairs > 0 ? sum / pairs : 0.0;
}

}  // namespace

int thumbnailsForRunLength(int views)
{
  return std::min(views, static_cast<int>(std::ceil(RUNS * std::sqrt(views))) + 2);
}

cv::Mat thumbnailOf(const cv::Mat& view)
{
  const double scale = static_cast<double>(THUMBNAIL_SIDE_PX) / std::max(view.cols, view.rows);
  const cv::Size size(std::max(2, static_cast<int>(std::lround(scale * view.cols))),
                      std::max(2, static_cast<int>(std::lround(scale * view.rows))));
  cv::Mat small;
  cv::resize(view, small, size, 0, 0, cv::INTER_AREA);
  cv::Mat thumbnail;
  toGrey(small).convertTo(thumbnail, CV_32F);
  return thumbnail;
}

RunLength findRunLength(const std::vector<cv::Mat>& thumbnails, int views, const IndexGridOptions& options)
{
  RunLength best;
  const int longest = std::min(views / 2, static_cast<int>(thumbnails.size()) - 2);
  for (int length = 2; length <= longest; ++length)
  {
    if (views % length != 0)
    {
      continue;
    }
    const double beside = differenceAt(thumbnails, length - 1) + differenceAt(thumbnails, length + 1);
    const double dip = beside > 0.0 ? 2.0 * differenceAt(thumbnails, length) / beside : 1.0;
    if (dip < best.dip)
    {
      best = {length, dip};
    }
  }
  if (best.dip > options.max_dip)
  {
    best.length = 0;
  }
  return best;
}

}  // namespace light_field_depth
