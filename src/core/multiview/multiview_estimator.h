#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MULTIVIEW_ESTIMATOR_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MULTIVIEW_ESTIMATOR_H

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/multiview_options.h"

namespace light_field_depth
{
namespace multiview
{
struct SceneMeasures;
}  // namespace multiview

/// Which views the estimator uses of those that it is asked for: the cross of a grid with a full one, unless
/// something else is asked for. The views need no images.
ViewSelection selectionOf(const LightField& light_field, ViewSelection wanted);

/// Solves the views of a light field together: truncated matching costs over arms of views, four-path
/// aggregation, explicit visibility, a decision on edge pixels by colour, and a refinement that linearises
/// all views at once. Works on any array of views.
class MultiviewEstimator : public Estimator
{
public:
  /// Views with more pixels are searched from coarse to fine.
  static constexpr int LARGE_PIXELS = 1'000'000;

  explicit MultiviewEstimator(MultiviewOptions options = {});
  ~MultiviewEstimator() override;

  void setOptions(const MultiviewOptions& options) { options_ = options; }

  DisparityEstimate estimate(const LightField& light_field, const EstimateRequest& request,
                             RunContext& context) override;

  /// The maps of other views for an estimate that was made without them, perhaps by another estimator: each
  /// view is solved like a light field of its own, in the range that is known. What this estimator carries
  /// from frame to frame stays as it is.
  /// @param light_field, request as they were given to estimate(), but for the number of maps
  /// @return EstimateRequest::solved_maps less the reference's, fewer where the views do not allow as many
  std::vector<ViewDisparity> solveOtherViews(const LightField& light_field, const EstimateRequest& request,
                                             const DisparityEstimate& estimate, RunContext& context);

private:
  struct FrameMemory;
  LightField reduced(const LightField& chosen, RunContext& context);
  void solve(const LightField& views, const EstimateRequest& request, RunContext& context,
             DisparityEstimate& estimate);
  bool follow(const LightField& views, const EstimateRequest& request, RunContext& context,
              DisparityEstimate& estimate);
  void solveCoarseToFine(const LightField& chosen, const multiview::SceneMeasures& measures,
                         RunContext& context);
  void keepResult(double unit, DisparityEstimate& estimate) const;
  void confirmPair(const LightField& chosen, const multiview::SceneMeasures& measures, RunContext& context,
                   DisparityEstimate& estimate);
  void upsample(const LightField& light_field, RunContext& context, DisparityEstimate& estimate);

  MultiviewOptions options_;
  std::unique_ptr<FrameMemory> memory_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_MULTIVIEW_ESTIMATOR_H
