#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_LINEARIZER_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_LINEARIZER_H

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/base/scratch_pool.h"
#include "core/light_field/view_set.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Where the quadratic approximation of the matching error of all views has its minimum.
struct Linearization
{
  /// CV_32FC1, curvature of the error: how well the images fix the disparity. See NoiseDiscount.
  cv::Mat weight;
  cv::Mat target;  ///< CV_32FC1, disparity of the minimum
  /// CV_32FC1, mean absolute difference to the reference in the arm that fits best, sum of three channels.
  cv::Mat residual;
  /// CV_32FC1, px: how far the pairs of opposite directions, each alone, would place the minimum apart.
  cv::Mat disagreement;
  cv::Mat noise;  ///< CV_32FC1, what noise adds to the curvature, on the mean
};

struct LinearizationSettings
{
  float max_step_px = 0.15F;     ///< the approximation holds for small steps only
  bool one_channel = false;      ///< the second of three alone: green
  bool brightness_slope = true;  ///< allow brightness that changes linearly with the position of the view
  int window_radius = 2;         ///< pixels that share one step
  /// Grey levels, sum of three channels: views that differ more from the reference drop out of the mean.
  float match_scale = 12.0F;
};

/// Linearises the difference of every view to the refocused mean (the reference averaged with the views that
/// agree with it where the present disparity says that they see the same point) about that disparity. The
/// mean has a fraction of a single view's noise, and its gradient stands for that of all views. Views of one
/// arm that fit badly lose their weight. Keeps its scratch memory; one call at a time.
class Linearizer
{
public:
  Linearizer();
  ~Linearizer();

  /// @param disparity CV_32FC1, finite
  /// @param slope_variance CV_32FC1, of the noise in derivatives of one view (ViewNoise); empty: none
  void run(const ViewSet& views, const cv::Mat& disparity, const cv::Mat& slope_variance,
           const LinearizationSettings& settings, ThreadPool& pool, Linearization& result);

private:
  struct Scratch;
  class Band;

  ScratchPool<Scratch> scratch_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_LINEARIZER_H
