#ifndef LIGHT_FIELD_DEPTH_SRC_EVALUATION_SURFACE_INDEX_H
#define LIGHT_FIELD_DEPTH_SRC_EVALUATION_SURFACE_INDEX_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// A point as (x / z, y / z, ln z). @pre z > 0
cv::Point3f projective(const cv::Point3f& point);

/// Finds the nearest of many points in bins over the first two coordinates.
class SurfaceIndex
{
public:
  /// @param points as projective() gives them, finite
  /// @param bin_size edge of the bins
  SurfaceIndex(const std::vector<cv::Point3f>& points, float bin_size);

  /// Distance to the nearest point, or `limit` if none is nearer. Thread safe.
  float distance(const cv::Point3f& query, float limit) const;

private:
  void search(int column, int row, const cv::Point3f& query, float& squared) const;

  float bin_size_;
  cv::Point2f origin_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> begins_;  ///< of each bin in points_
  std::vector<cv::Point3f> points_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_EVALUATION_SURFACE_INDEX_H
