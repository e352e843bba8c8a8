#include "core/multiview/solver.h"

#include <algorithm>
#include <cstdint>

#include "core/multiview/maps/blank_planes.h"
#include "core/multiview/maps/confidence.h"
#include "core/multiview/maps/filled_regions.h"

namespace light_field_depth::multiview
{
namespace
{
/// Bytes hold labels plus VISIBILITY_BIAS; below MAX_VISIBILITY_LABELS.
constexpr int MAX_LABELS = 240;

}  // namespace

void Solver::run(const LightField& light_field, const SolverSettings& settings, RunContext& context)
{
  solve(light_field, settings, cv::Mat(), context);
}

void Solver::runNear(const LightField& light_field, const SolverSettings& settings, const cv::Mat& disparity,
                     RunContext& context)
{
  solve(light_field, settings, disparity, context);
}

bool Solver::follow(const LightField& light_field, const SolverSettings& settings, RunContext& context)
{
  return solve(light_field, settings, disparity_, context);
}

const cv::Mat& Solver::search(const LightField& light_field, const SolverSettings& settings,
                              RunContext& context)
{
  const LabelSpace labels = makeLabelSpace(settings.range, settings.label_step_px, MAX_LABELS);
  prepare(light_field, settings, labels, context);
  search_.run({views_, guide(), labels}, settings.search, cv::Mat(), context, searched_);
  return searched_.last;
}

bool Solver::solve(const LightField& light_field, const SolverSettings& settings, const cv::Mat& around,
                   RunContext& context)
{
  const LabelSpace labels = makeLabelSpace(settings.range, settings.label_step_px, MAX_LABELS);
  prepare(light_field, settings, labels, context);
  if (!search_.run({views_, guide(), labels}, settings.search, around, context, searched_))
  {
    return false;
  }
  if (settings.decide_boundary_pixels)
  {
    const StageTimer timer(context, "boundary_pixels");
    decideBoundaryPixels(guide(), settings.boundary_pixels, context.pool, searched_.last, boundary_scratch_);
  }
  context.save("multiview_searched", searched_.last);
  refinement_.run({views_, guide(), labels.range()}, settings.refinement, searched_.last, context,
                  disparity_);
  rateConfidence(settings.noise_sigma, context);
  return true;
}

void Solver::prepare(const LightField& light_field, const SolverSettings& settings, const LabelSpace& labels,
                     RunContext& context)
{
  const StageTimer timer(context, "prepare");
  ViewSetSettings view_settings;
  view_settings.grey = settings.grey_search;
  view_settings.blur_sigma_px = settings.blur_sigma_px;
  view_settings.range = labels.range();
  prepareViews(light_field, view_settings, context.pool, views_);
  colour_reference_ = PlanarImage();
  if (settings.grey_search && light_field.reference().image.channels() > 1)
  {
    view_settings.grey = false;
    preparePlanar(light_field.reference().image, view_settings, views_.reference.pad(), colour_reference_);
  }
}

cv::Mat Solver::filled() const
{
  cv::Mat filled = findFilled(refinement_.share(), disparity_);
  filled.setTo(0, held_);
  return filled;
}

cv::Mat Solver::unmeasured() const
{
  return findUnmeasured(refinement_.share(), disparity_.size());
}

void Solver::rateConfidence(float noise_sigma, RunContext& context)
{
  const Linearization& linearization = refinement_.linearization();
  context.save("multiview_curvature", linearization.weight);
  context.save("multiview_residual", linearization.residual);
  context.save("multiview_disagreement", linearization.disagreement);
  context.save("multiview_target", linearization.target);
  const StageTimer timer(context, "confidence");
  estimateConfidence({disparity_, searched_.last, searched_.first, linearization, noise_sigma}, context.pool,
                     confidence_);
  held_ = holdBlankPlanes(refinement_.share(), guide(), {}, disparity_, confidence_);
  if (views_.reference_masked.width() > 0)
  {
    forgetMasked();
  }
}

/// The maps of other views are made of what is certain alone.
void Solver::forgetMasked()
{
  for (int y = 0; y < confidence_.rows; ++y)
  {
    const std::uint8_t* const masked = views_.reference_masked.row(y);
    auto* const row = confidence_.ptr<float>(y);
    std::transform(masked, masked + confidence_.cols, row, row,
                   [](std::uint8_t is_masked, float value) { return is_masked != 0 ? 0.0F : value; });
  }
}

}  // namespace light_field_depth::multiview
