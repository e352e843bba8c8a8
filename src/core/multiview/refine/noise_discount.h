#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_NOISE_DISCOUNT_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_NOISE_DISCOUNT_H

#include <vector>

#include <opencv2/core.hpp>

#include "core/base/scratch_pool.h"
#include "core/multiview/refine/linearizer.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
struct NoiseDiscountSettings
{
  /// Beta, in parts of the curvature that noise adds on the mean. Light fields with noise of 5 levels and
  /// from a camera model: 0.5 leaves a sixth more roughness, 1.25 costs 2 % of the mean square error.
  float margin = 1.0F;
  /// Where the curvature about a pixel is less than this many times what noise alone adds, the views say
  /// nothing there, however strong single windows look; above `full_from` all counts. The noise is known to
  /// a tenth or two.
  float nothing_below = 1.15F;
  float full_from = 1.4F;
  /// Of one pixel where there is no noise, so that strong texture does not outvote all smoothness: what views
  /// get wrong together does not average out in a window. docs/experiments.md has 8 to 400.
  float max_weight = 100.0F;
};

/// Turns the curvature of a linearisation into the weight of its data: noise makes slopes, and so looks like
/// texture on blank paper and walls. Keeps its memory; one call at a time.
class NoiseDiscount
{
public:
  /// @param linearization its weight is the curvature on entry and the weight on return
  void apply(const NoiseDiscountSettings& settings, ThreadPool& pool, Linearization& linearization);

  /// CV_32FC1, in cells of CELL_PX (cell_sums.h): the part of the data that counts about each, 0..1.
  const cv::Mat& share() const { return share_; }

private:
  using Scratch = std::vector<float>;

  void sumCells(const Linearization& linearization, ThreadPool& pool);
  void findShare(const NoiseDiscountSettings& settings, ThreadPool& pool);

  cv::Mat curvature_;  // capped, in cells
  cv::Mat noise_;
  cv::Mat share_;
  ScratchPool<Scratch> scratch_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_NOISE_DISCOUNT_H
