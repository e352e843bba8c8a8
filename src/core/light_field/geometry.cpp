#include "light_field_depth/core/geometry.h"

#include <cmath>
#include <limits>

namespace light_field_depth
{
float depthFromDisparity(float disparity_px, const Calibration& calibration)
{
  const double absolute_disparity = disparity_px + calibration.disparity_offset_px;
  if (!(absolute_disparity > 0.0) || std::isinf(absolute_disparity))
  {
    return std::numeric_limits<float>::quiet_NaN();
  }
  const double depth_m = calibration.focal_length_px * calibration.baseline_m / absolute_disparity;
  // What single precision cannot hold is as good as unknown, too.
  const bool is_a_depth =
      depth_m >= std::numeric_limits<float>::min() && depth_m <= std::numeric_limits<float>::max();
  return is_a_depth ? static_cast<float>(depth_m) : std::numeric_limits<float>::quiet_NaN();
}

float disparityFromDepth(float depth_m, const Calibration& calibration)
{
  return static_cast<float>(calibration.focal_length_px * calibration.baseline_m / depth_m -
                            calibration.disparity_offset_px);
}

cv::Mat depthMap(const cv::Mat& disparity, const Calibration& calibration)
{
  cv::Mat depth(disparity.size(), CV_32FC1);
  for (int y = 0; y < disparity.rows; ++y)
  {
    const float* const disparity_row = disparity.ptr<float>(y);
    float* const depth_row = depth.ptr<float>(y);
    for (int x = 0; x < disparity.cols; ++x)
    {
      depth_row[x] = depthFromDisparity(disparity_row[x], calibration);
    }
  }
  return depth;
}

cv::Mat limitDepth(const cv::Mat& disparity, const Calibration& calibration, float min_depth_m,
                   float max_depth_m)
{
  if (min_depth_m <= 0.0F && max_depth_m <= 0.0F)
  {
    return disparity;
  }
  constexpr float UNLIMITED = std::numeric_limits<float>::infinity();
  const float nearest = min_depth_m > 0.0F ? disparityFromDepth(min_depth_m, calibration) : UNLIMITED;
  const float farthest = max_depth_m > 0.0F ? disparityFromDepth(max_depth_m, calibration) : -UNLIMITED;
  cv::Mat limited(disparity.size(), CV_32FC1);
  for (int y = 0; y < disparity.rows; ++y)
  {
    const float* const given = disparity.ptr<float>(y);
    float* const out = limited.ptr<float>(y);
    for (int x = 0; x < disparity.cols; ++x)
    {
      const bool within = given[x] >= farthest && given[x] <= nearest;
      out[x] = within ? given[x] : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return limited;
}

}  // namespace light_field_depth
