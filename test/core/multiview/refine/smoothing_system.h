#ifndef LIGHT_FIELD_DEPTH_TEST_CORE_MULTIVIEW_REFINE_SMOOTHING_SYSTEM_H
#define LIGHT_FIELD_DEPTH_TEST_CORE_MULTIVIEW_REFINE_SMOOTHING_SYSTEM_H

#include <algorithm>

#include <opencv2/core.hpp>

#include "core/multiview/refine/smoothing_kernels.h"
#include "support/random_rows.h"

namespace light_field_depth::testing
{
/// Everything that a system of the smoothing is made of, at random.
struct SmoothingSystem
{
  explicit SmoothingSystem(int height, int width)
      : weight(randomMap(height, width, 0.0F, 400.0F)), target(randomMap(height, width, -3.0F, 3.0F)),
        left(randomMap(height, width + 1, 0.0F, 200.0F)), up(randomMap(height + 1, width, 0.0F, 200.0F)),
        disparity(randomMap(height, width, -3.0F, 3.0F))
  {
    left.col(0).setTo(0.0F);
    left.col(width).setTo(0.0F);
    up.row(0).setTo(0.0F);
    up.row(height).setTo(0.0F);
  }

  multiview::SystemRow row(int y, cv::Mat& values) const
  {
    return {weight.ptr<float>(y),
            target.ptr<float>(y),
            left.ptr<float>(y),
            up.ptr<float>(y),
            up.ptr<float>(y + 1),
            values.ptr<float>(std::max(y - 1, 0)),
            values.ptr<float>(std::min(y + 1, values.rows - 1)),
            values.ptr<float>(y)};
  }

  cv::Mat weight;
  cv::Mat target;
  cv::Mat left;
  cv::Mat up;
  cv::Mat disparity;
};

/// Bit for bit; there is no NaN.
inline bool equal(const cv::Mat& a, const cv::Mat& b)
{
  return std::equal(a.begin<float>(), a.end<float>(), b.begin<float>(), b.end<float>());
}

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_CORE_MULTIVIEW_REFINE_SMOOTHING_SYSTEM_H
