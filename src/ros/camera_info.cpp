#include "ros/camera_info.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace light_field_depth
{
namespace
{
/// Of an entry of R from the identity; calibration files round to more digits than that.
constexpr double SAME_ROTATION = 1e-6;

/// Divides one row of K (3 columns) and of P (4 columns) by the binning.
void binRow(sensor_msgs::CameraInfo& info, std::size_t row, std::uint32_t binning)
{
  for (std::size_t column = 0; column < 3; ++column)
  {
    info.K[3 * row + column] /= binning;
  }
  for (std::size_t column = 0; column < 4; ++column)
  {
    info.P[4 * row + column] /= binning;
  }
}

}  // namespace

sensor_msgs::CameraInfo ofDeliveredImage(const sensor_msgs::CameraInfo& info)
{
  sensor_msgs::CameraInfo delivered = info;
  const sensor_msgs::RegionOfInterest& region = info.roi;
  const std::uint32_t binning_x = std::max(1U, info.binning_x);
  const std::uint32_t binning_y = std::max(1U, info.binning_y);
  // A region of no size is the whole image. Its corner counts in pixels before binning.
  delivered.width = (region.width > 0 ? region.width : info.width) / binning_x;
  delivered.height = (region.height > 0 ? region.height : info.height) / binning_y;
  delivered.K[2] -= region.x_offset;
  delivered.K[5] -= region.y_offset;
  delivered.P[2] -= region.x_offset;
  delivered.P[6] -= region.y_offset;
  binRow(delivered, 0, binning_x);
  binRow(delivered, 1, binning_y);
  delivered.roi = sensor_msgs::RegionOfInterest();
  delivered.binning_x = 0;
  delivered.binning_y = 0;
  return delivered;
}

bool sameCamera(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b)
{
  return a.width == b.width && a.height == b.height && a.distortion_model == b.distortion_model &&
         a.D == b.D && a.K == b.K && a.R == b.R && a.P == b.P && a.binning_x == b.binning_x &&
         a.binning_y == b.binning_y && a.roi == b.roi;
}

bool isDistortedOrTurned(const sensor_msgs::CameraInfo& info)
{
  const bool distorted =
      std::any_of(info.D.begin(), info.D.end(), [](double coefficient) { return coefficient != 0.0; });
  double difference = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < info.R.size(); ++i)
  {
    difference = std::max(difference, std::abs(info.R[i] - (i % 4 == 0 ? 1.0 : 0.0)));
    sum += std::abs(info.R[i]);
  }
  const bool turned = sum > 0.0 && difference > SAME_ROTATION;  // an R of zeros has not been set
  return distorted || turned;
}

bool isUncalibrated(const sensor_msgs::CameraInfo& info)
{
  return std::all_of(info.P.begin(), info.P.end(), [](double entry) { return entry == 0.0; });
}

}  // namespace light_field_depth
