#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SOLVER_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SOLVER_H

#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "core/multiview/maps/boundary_pixels.h"
#include "core/multiview/refine/map_refinement.h"
#include "core/multiview/search/label_search.h"
#include "core/multiview/search/label_space.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/run_context.h"

namespace light_field_depth::multiview
{
/// Everything that one run of the stages needs to know.
struct SolverSettings
{
  DisparityRange range;
  float label_step_px = 0.125F;
  bool grey_search = false;
  float noise_sigma = 0.0F;    ///< of the views as given, in 8-bit units
  double blur_sigma_px = 0.0;  ///< of the views before anything else
  SearchSettings search;
  bool decide_boundary_pixels = true;
  BoundaryPixelSettings boundary_pixels;
  RefinementSettings refinement;
};

/// Runs the stages of the multi-view method in order. Keeps its buffers; one call at a time.
class Solver
{
public:
  /// @param light_field 8-bit views whose outermost one stands about four steps from the reference
  void run(const LightField& light_field, const SolverSettings& settings, RunContext& context);

  /// The same, but near a map that is known already: costs and memory for the labels about it alone.
  /// @param settings without search.detect_changes
  /// @param disparity CV_32FC1 in the unit of the light field, finite, of the size of the views
  void runNear(const LightField& light_field, const SolverSettings& settings, const cv::Mat& disparity,
               RunContext& context);

  /// The next frame of the same views: searches the labels near the last map, and all where the scene has
  /// changed. Everything in the result comes from this frame's images.
  /// @pre the last call succeeded, with views at the same places and the same settings,
  /// search.detect_changes among them
  /// @return false if this is another scene; the results are then those of no frame, and run() is due
  bool follow(const LightField& light_field, const SolverSettings& settings, RunContext& context);

  /// The search alone, without refinement and confidence: disparity() and what belongs to it stay those of
  /// the last run. @return CV_32FC1 in the unit of the light field; overwritten by the next call
  const cv::Mat& search(const LightField& light_field, const SolverSettings& settings, RunContext& context);

  /// CV_32FC1 results of the last run; overwritten by the next.
  const cv::Mat& disparity() const { return disparity_; }
  const cv::Mat& confidence() const { return confidence_; }
  /// CV_8UC1 of the last run, 255 where the views say nothing above their noise, so that the disparity is
  /// filled from what lies around.
  cv::Mat filled() const;
  /// The same whether a plane around holds the disparity or not.
  cv::Mat unmeasured() const;
  /// CV_8UC1 of the last run, 255 where holdBlankPlanes() moved the disparity.
  const cv::Mat& held() const { return held_; }

private:
  bool solve(const LightField& light_field, const SolverSettings& settings, const cv::Mat& around,
             RunContext& context);
  void prepare(const LightField& light_field, const SolverSettings& settings, const LabelSpace& labels,
               RunContext& context);
  void rateConfidence(float noise_sigma, RunContext& context);
  void forgetMasked();
  const PlanarImage& guide() const
  {
    return colour_reference_.width() > 0 ? colour_reference_ : views_.reference;
  }

  ViewSet views_;
  PlanarImage colour_reference_;  // only where the views are grey and the light field is not
  LabelSearch search_;
  SearchMaps searched_;
  MapRefinement refinement_;
  cv::Mat boundary_scratch_;
  cv::Mat disparity_;
  cv::Mat confidence_;
  cv::Mat held_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SOLVER_H
