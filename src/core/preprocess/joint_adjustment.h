#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_JOINT_ADJUSTMENT_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_JOINT_ADJUSTMENT_H

#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/registration.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// The views of a light field with their slopes, which every step looks at. Refers to the light field.
struct SlopedViews
{
  /// @param grey 8-bit grey views
  SlopedViews(const LightField& grey, ThreadPool& pool);

  const LightField& light_field;
  std::vector<cv::Mat> images;  ///< CV_32FC3: value, slope along x, slope along y; one a view
};

/// A pixel of the reference and its disparity.
struct AdjustedPoint
{
  cv::Point pixel;
  float disparity = 0.0F;
};

/// What adjustJointly() starts from and improves. Pixels are those of the views.
struct Adjustment
{
  std::vector<AdjustedPoint> points;
  double step_ratio = 1.0;
  bool steps_are_known = false;   ///< the ratio stays as it is
  std::vector<ViewMisfit> views;  ///< of all views, the reference's stays 0
};

/// Gauss-Newton steps for the disparities of the points, the misfits of all views and the ratio of steps
/// together, on the differences between each view and the reference at the points, reweighted robustly. The
/// disparities are eliminated (Schur complement), so that few steps suffice although each view alone could be
/// explained by them.
/// @param expected_px how far views are off, standard deviation; holds what the images do not tell
void adjustJointly(const SlopedViews& views, double expected_px, int steps, ThreadPool& pool,
                   Adjustment& adjustment);

/// How badly each of some adjustments of the same points fits, each point at the disparity near its own that
/// fits it best: means over points and views of a robust measure of the differences to the reference, on the
/// scale of the first one's. Points that took no part in the adjustments tell which of them is right.
std::vector<double> compareFits(const SlopedViews& views, std::vector<Adjustment> adjustments,
                                ThreadPool& pool);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_JOINT_ADJUSTMENT_H
