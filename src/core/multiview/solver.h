#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SOLVER_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SOLVER_H

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "core/multiview/maps/boundary_pixels.h"
#include "core/multiview/refine/edge_aware_smoothing.h"
#include "core/multiview/refine/noise_discount.h"
#include "core/multiview/refine/refinement.h"
#include "core/multiview/search/background_fusion.h"
#include "core/multiview/search/change_detection.h"
#include "core/multiview/search/cost_volume.h"
#include "core/multiview/search/label_bands.h"
#include "core/multiview/search/label_space.h"
#include "core/multiview/search/median.h"
#include "core/multiview/search/path_aggregation.h"
#include "core/multiview/search/thin_structures.h"
#include "core/multiview/search/visibility.h"
#include "core/preprocess/view_noise.h"
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
  CostSettings cost;
  PathSettings paths;  ///< small_change_penalty for labels 1/8 px apart, scaled to what the range needs
  /// Of P1 and P2 in the last search. The first one has to find the surfaces from costs that occlusions
  /// spoil; the last one knows who sees what, and may follow their shapes and contours more freely.
  float last_small_change_share = 1.5F;
  float last_large_change_share = 0.75F;
  int visibility_passes = 1;
  bool fuse_background = true;
  bool keep_thin_structures = false;
  bool decide_boundary_pixels = true;
  BoundaryPixelSettings boundary_pixels;
  int refinements = 2;
  LinearizationSettings linearization;
  NoiseDiscountSettings noise_discount;
  SmoothingSettings smoothing;
  /// Links strengthen by this part for each squared grey level of noise that the views are left with.
  float strength_per_variance = 0.75F;
  bool detect_changes = false;  ///< so that the next frame may follow
};

/// Runs the stages of the multi-view method in order. Keeps its buffers; one call at a time.
class Solver
{
public:
  /// @param light_field 8-bit views whose outermost one stands about four steps from the reference
  void run(const LightField& light_field, const SolverSettings& settings, RunContext& context);

  /// The same, but near a map that is known already: costs and memory for the labels about it alone.
  /// @param settings without detect_changes
  /// @param disparity CV_32FC1 in the unit of the light field, finite, of the size of the views
  void runNear(const LightField& light_field, const SolverSettings& settings, const cv::Mat& disparity,
               RunContext& context);

  /// The next frame of the same views: searches the labels near the last map, and all where the scene has
  /// changed. Everything in the result comes from this frame's images.
  /// @pre the last call succeeded, with views at the same places and the same settings, detect_changes among
  /// them
  /// @return false if this is another scene; the results are then those of no frame, and run() is due
  bool follow(const LightField& light_field, const SolverSettings& settings, RunContext& context);

  /// CV_32FC1 results of the last run; overwritten by the next.
  const cv::Mat& disparity() const { return disparity_; }
  const cv::Mat& confidence() const { return confidence_; }
  /// CV_8UC1 of the last run, 255 where the views say nothing above their noise, so that the disparity is
  /// filled from what lies around.
  cv::Mat filled() const;
  /// The same whether a plane around holds the disparity or not.
  cv::Mat unmeasured() const;

private:
  void prepare(const LightField& light_field, const SolverSettings& settings, RunContext& context);
  enum class SearchIn
  {
    AllLabels,
    BandsAroundLast
  };
  bool solve(const SolverSettings& settings, SearchIn where, RunContext& context);
  bool search(const SolverSettings& settings, SearchIn where, RunContext& context);
  bool computeFirstCosts(const SolverSettings& settings, const CostSettings& cost, SearchIn where,
                         RunContext& context);
  bool acceptFirstMap(SearchIn where, RunContext& context);
  void setPaths(const PathSettings& paths, RunContext& context);
  void aggregate(const SolverSettings& settings, RunContext& context);
  void fuseBackground(const SolverSettings& settings, RunContext& context);
  void refine(const SolverSettings& settings, RunContext& context);
  void linearize(const SolverSettings& settings, RunContext& context);
  void keepNearLabels(RunContext& context);
  void rateConfidence(const SolverSettings& settings, RunContext& context);
  void forgetMasked();
  const PlanarImage& guide() const
  {
    return colour_reference_.width() > 0 ? colour_reference_ : views_.reference;
  }

  ViewSet views_;
  PlanarImage colour_reference_;  ///< only where the views are grey and the light field is not
  LabelSpace labels_;
  PathSettings paths_;
  LabelBands bands_;
  CostVolumeBuilder cost_builder_;
  CostVolume volume_;
  ChangeDetector changes_;
  std::vector<std::uint8_t> changed_tiles_;
  PathAggregator aggregator_;
  MedianFilter median_;
  BackgroundFusion background_;
  VisibleSurfaces surfaces_;
  Linearizer linearizer_;
  Linearization linearization_;
  ViewNoise noise_;
  NoiseDiscount discount_;
  EdgeAwareSmoother smoother_;
  cv::Mat label_;
  cv::Mat scratch_;
  cv::Mat first_search_;
  cv::Mat searched_;
  cv::Mat disparity_;
  cv::Mat confidence_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SOLVER_H
