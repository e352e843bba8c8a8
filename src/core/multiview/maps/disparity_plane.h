#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_DISPARITY_PLANE_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_DISPARITY_PLANE_H

#include <array>
#include <cmath>
#include <optional>

#include <opencv2/core.hpp>

namespace light_field_depth::multiview
{
/// A plane of the scene: disparity = gradient . (x, y) + offset.
struct DisparityPlane
{
  cv::Vec3d coefficients;

  double at(double x, double y) const { return coefficients.dot({x, y, 1.0}); }
};

/// @param points x, y and disparity
/// @return nothing where they are in one line of the image
inline std::optional<DisparityPlane> planeThrough(const std::array<cv::Vec3d, 3>& points)
{
  const cv::Vec3d normal = (points[1] - points[0]).cross(points[2] - points[0]);
  if (std::abs(normal[2]) < 1e-6 || !std::isfinite(normal[2]))
  {
    return std::nullopt;
  }
  return DisparityPlane{{-normal[0] / normal[2], -normal[1] / normal[2], normal.dot(points[0]) / normal[2]}};
}

inline bool isOn(const DisparityPlane& plane, const cv::Vec3d& point, double tolerance)
{
  return std::abs(plane.at(point[0], point[1]) - point[2]) <= tolerance;
}

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MAPS_DISPARITY_PLANE_H
