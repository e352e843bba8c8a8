#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_UNPROJECTION_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_UNPROJECTION_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/point_cloud.h"

namespace light_field_depth::cloud
{
/// The camera of one view as the unprojection needs it, in the frame of the reference view.
struct ViewCamera
{
  double focal_length_px;
  cv::Point2d principal_point_px;
  cv::Point2d centre_m;
};

inline ViewCamera cameraOf(const View& view, const Calibration& calibration)
{
  // A point at depth Z moves by -steps * (d + d_inf) through parallax and by +steps * d_inf + offset_px
  // through the principal point.
  ViewCamera camera;
  camera.focal_length_px = calibration.focal_length_px;
  camera.principal_point_px =
      calibration.principal_point_px + view.steps * calibration.disparity_offset_px + view.offset_px;
  camera.centre_m = view.steps * calibration.baseline_m;
  return camera;
}

/// Reads one row of colours as b, g, r of 8 bits.
class ColorReader
{
public:
  explicit ColorReader(const cv::Mat& image) : image_(image), channels_(image.channels()) {}

  void paint(int y, int x, ColoredPoint& point) const
  {
    const std::uint8_t* const pixel =
        image_.ptr<std::uint8_t>(y) + static_cast<std::ptrdiff_t>(x) * channels_;
    point.b = pixel[0];
    point.g = pixel[channels_ == 3 ? 1 : 0];
    point.r = pixel[channels_ == 3 ? 2 : 0];
    point.unused = 0;
    point.confidence = 0.0F;
  }

private:
  const cv::Mat& image_;
  int channels_;
};

inline bool isTrusted(const cv::Mat& confidence, int y, int x, float min_confidence)
{
  return confidence.empty() || confidence.at<float>(y, x) >= min_confidence;
}

/// Rays of one row of one view's pixels: x, y of the points at depth 1, and what is added to them.
class RowUnprojection
{
public:
  RowUnprojection(const View& view, const Calibration& calibration)
      : camera_(cameraOf(view, calibration)), colors_(view.image),
        focal_times_baseline_(calibration.focal_length_px * calibration.baseline_m),
        disparity_offset_px_(calibration.disparity_offset_px), ray_step_(1.0 / calibration.focal_length_px)
  {
  }

  /// Whether a disparity gives a depth. As in depthFromDisparity().
  bool isFinite(float disparity) const { return std::isfinite(depthOf(disparity)); }

  /// x, y, z and the colour of one pixel, of confidence 0; NaN where the disparity gives no depth.
  ColoredPoint point(int y, int x, float disparity) const
  {
    const float z = depthOf(disparity);
    ColoredPoint point;
    point.x = static_cast<float>(camera_.centre_m.x + (x - camera_.principal_point_px.x) * ray_step_ * z);
    point.y = static_cast<float>(camera_.centre_m.y + (y - camera_.principal_point_px.y) * ray_step_ * z);
    point.z = z;
    colors_.paint(y, x, point);
    return point;
  }

private:
  float depthOf(float disparity) const
  {
    const double absolute = disparity + disparity_offset_px_;
    const bool valid = absolute > 0.0 && absolute <= std::numeric_limits<double>::max();
    const auto depth = static_cast<float>(focal_times_baseline_ / absolute);
    return valid ? depth : std::numeric_limits<float>::quiet_NaN();
  }

  ViewCamera camera_;
  ColorReader colors_;
  double focal_times_baseline_;
  double disparity_offset_px_;
  double ray_step_;
};

}  // namespace light_field_depth::cloud

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_UNPROJECTION_H
