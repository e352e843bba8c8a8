#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_MAP_REFINEMENT_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_MAP_REFINEMENT_H

#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "core/multiview/refine/edge_aware_smoothing.h"
#include "core/multiview/refine/linearizer.h"
#include "core/multiview/refine/noise_discount.h"
#include "core/preprocess/view_noise.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/run_context.h"

namespace light_field_depth::multiview
{
struct RefinementSettings
{
  int refinements = 2;
  /// With no more noise than this, in squared levels, the first of several refinements compares one channel
  /// of the views alone, in half the time. Of clean views antinous has 0.13 and loses 0.04 % BadPix 0.07,
  /// cotton has 0.24 and loses nothing; a camera model's antinous has 0.9 and would lose 1 %.
  float one_channel_max_variance = 0.35F;
  LinearizationSettings linearization;
  NoiseDiscountSettings noise_discount;
  SmoothingSettings smoothing;
  /// Links strengthen by this part for each squared grey level of noise that the views are left with, and so
  /// do the most that a pixel weighs and the disagreement of rows and columns that noise explains.
  float strength_per_variance = 0.75F;
};

/// What is refined.
struct RefinementInput
{
  const ViewSet& views;
  const PlanarImage& guide;  ///< the reference; its edges weaken the links of pixels
  DisparityRange range;      ///< of the search
};

/// Improves a map below the distance of labels: linearises the views about it, takes what noise adds off the
/// weight of the data, and smooths; repeatedly. Keeps its buffers; one call at a time.
class MapRefinement
{
public:
  /// @param start CV_32FC1, px, finite  @param disparity the result, CV_32FC1; not the same as start
  void run(const RefinementInput& input, const RefinementSettings& settings, const cv::Mat& start,
           RunContext& context, cv::Mat& disparity);

  /// Of the last refinement of the last run; of its start where the settings ask for none.
  const Linearization& linearization() const { return linearization_; }
  /// CV_32FC1, in cells of CELL_PX (cell_sums.h): the part of the data that counts about each, 0..1.
  const cv::Mat& share() const { return discount_.share(); }

private:
  void linearize(const RefinementInput& input, const LinearizationSettings& settings,
                 const NoiseDiscountSettings& discount, float growth, RunContext& context,
                 const cv::Mat& disparity);

  Linearizer linearizer_;
  Linearization linearization_;
  ViewNoise noise_;
  NoiseDiscount discount_;
  EdgeAwareSmoother smoother_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_MAP_REFINEMENT_H
