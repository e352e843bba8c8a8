#include "evaluation/surface_index.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
/// Wider than any camera; keeps a stray point from asking for all memory.
constexpr float MAX_BINS_PER_SIDE = 20000.0F;

}  // namespace

cv::Point3f projective(const cv::Point3f& point)
{
  return {point.x / point.z, point.y / point.z, std::log(point.z)};
}

SurfaceIndex::SurfaceIndex(const std::vector<cv::Point3f>& points, float bin_size) : bin_size_(bin_size)
{
  CV_Assert(!points.empty());
  cv::Point2f last = {points.front().x, points.front().y};
  origin_ = last;
  for (const cv::Point3f& point : points)
  {
    origin_ = {std::min(origin_.x, point.x), std::min(origin_.y, point.y)};
    last = {std::max(last.x, point.x), std::max(last.y, point.y)};
  }
  const float widest = std::max(last.x - origin_.x, last.y - origin_.y);
  bin_size_ = std::max(bin_size_, widest / MAX_BINS_PER_SIDE);
  columns_ = static_cast<int>((last.x - origin_.x) / bin_size_) + 1;
  rows_ = static_cast<int>((last.y - origin_.y) / bin_size_) + 1;
  const auto bin_of = [&](const cv::Point3f& point)
  {
    const int column = std::min(static_cast<int>((point.x - origin_.x) / bin_size_), columns_ - 1);
    const int row = std::min(static_cast<int>((point.y - origin_.y) / bin_size_), rows_ - 1);
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  };
  begins_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const cv::Point3f& point : points)
  {
    ++begins_[bin_of(point) + 1];
  }
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
  points_.resize(points.size());
  for (const cv::Point3f& point : points)
  {
    points_[next[bin_of(point)]++] = point;
  }
}

void SurfaceIndex::search(int column, int row, const cv::Point3f& query, float& squared) const
{
  if (column < 0 || column >= columns_ || row < 0 || row >= rows_)
  {
    return;
  }
  const auto bin =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  for (std::uint32_t i = begins_[bin]; i < begins_[bin + 1]; ++i)
  {
    const cv::Point3f gap = points_[i] - query;
    squared = std::min(squared, gap.dot(gap));
  }
}

float SurfaceIndex::distance(const cv::Point3f& query, float limit) const
{
  // Rings of bins about the query's own; those of ring r are at least r - 1 bins away.
  const float centre_x = (query.x - origin_.x) / bin_size_;
  const float centre_y = (query.y - origin_.y) / bin_size_;
  const float reach = limit / bin_size_ + 1.0F;
  const bool far_away = !(centre_x > -reach && centre_x < static_cast<float>(columns_) + reach &&
                          centre_y > -reach && centre_y < static_cast<float>(rows_) + reach);
  if (far_away)
  {
    return limit;
  }
  const int column = cvFloor(centre_x);
  const int row = cvFloor(centre_y);
  float squared = limit * limit;
  search(column, row, query, squared);
  for (int ring = 1;; ++ring)
  {
    const float least = static_cast<float>(ring - 1) * bin_size_;
    if (least * least >= squared)
    {
      break;
    }
    for (int i = -ring; i <= ring; ++i)
    {
      search(column + i, row - ring, query, squared);
      search(column + i, row + ring, query, squared);
    }
    for (int i = -ring + 1; i < ring; ++i)
    {
      search(column - ring, row + i, query, squared);
      search(column + ring, row + i, query, squared);
    }
  }
  return std::sqrt(squared);
}

}  // namespace light_field_depth
