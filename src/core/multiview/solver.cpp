#include "core/multiview/solver.h"

#include <algorithm>

#include "core/multiview/maps/confidence.h"
#include "core/multiview/maps/filled_regions.h"

namespace light_field_depth::multiview
{
namespace
{
/// How far a refined disparity may lie outside the labels, in pixels: slopes of surfaces at the end of the
/// range go on.
constexpr float REFINEMENT_REACH_PX = 1.0F;
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 32;

/// Bytes hold labels plus VISIBILITY_BIAS; below MAX_VISIBILITY_LABELS.
constexpr int MAX_LABELS = 240;
/// A later search tries the labels that the one before found within so many pixels of a tile, and so many
/// more.
constexpr int BAND_REACH_PX = 8;
constexpr float BAND_MARGIN_LABELS = 4.0F;
/// The same for the first search of a frame that follows another one, whose objects may have moved.
constexpr int FOLLOWED_REACH_PX = 12;
constexpr float FOLLOWED_MARGIN_LABELS = 4.0F;
/// Distance of the labels that SolverSettings::paths is meant for.
constexpr float UNIT_LABEL_STEP_PX = 0.125F;
/// Of a penalty: the sum over four paths, each FULL_COST and a penalty at the most, stays in 16 bits.
constexpr int MAX_STEP = 12000;
/// A difference of grey values compared with the sum of the differences of three channels.
constexpr float GREY_SHARE = 0.4F;

PathSettings lastPaths(PathSettings paths, const SolverSettings& settings)
{
  paths.small_change_penalty =
      cvRound(settings.last_small_change_share * static_cast<float>(paths.small_change_penalty));
  paths.large_change_penalty =
      cvRound(settings.last_large_change_share * static_cast<float>(paths.large_change_penalty));
  return paths;
}

}  // namespace

void Solver::run(const LightField& light_field, const SolverSettings& settings, RunContext& context)
{
  prepare(light_field, settings, context);
  solve(settings, SearchIn::AllLabels, context);
}

void Solver::runNear(const LightField& light_field, const SolverSettings& settings, const cv::Mat& disparity,
                     RunContext& context)
{
  disparity.copyTo(disparity_);
  prepare(light_field, settings, context);
  solve(settings, SearchIn::BandsAroundLast, context);
}

bool Solver::follow(const LightField& light_field, const SolverSettings& settings, RunContext& context)
{
  prepare(light_field, settings, context);
  return solve(settings, SearchIn::BandsAroundLast, context);
}

bool Solver::solve(const SolverSettings& settings, SearchIn where, RunContext& context)
{
  if (!search(settings, where, context))
  {
    return false;
  }
  if (settings.decide_boundary_pixels)
  {
    const StageTimer timer(context, "boundary_pixels");
    decideBoundaryPixels(guide(), settings.boundary_pixels, context.pool, disparity_, scratch_);
  }
  disparity_.copyTo(searched_);
  context.save("multiview_searched", searched_);
  refine(settings, context);
  rateConfidence(settings, context);
  return true;
}

void Solver::prepare(const LightField& light_field, const SolverSettings& settings, RunContext& context)
{
  const StageTimer timer(context, "prepare");
  labels_ = makeLabelSpace(settings.range, settings.label_step_px, MAX_LABELS);
  paths_ = settings.paths;
  const float small_change_penalty =
      static_cast<float>(paths_.small_change_penalty) * labels_.step_px / UNIT_LABEL_STEP_PX;
  paths_.small_change_penalty = cvRound(small_change_penalty);
  ViewSetSettings view_settings;
  view_settings.grey = settings.grey_search;
  view_settings.blur_sigma_px = settings.blur_sigma_px;
  view_settings.range = {labels_.disparity(0.0F), labels_.disparity(static_cast<float>(labels_.count - 1))};
  prepareViews(light_field, view_settings, context.pool, views_);
  colour_reference_ = PlanarImage();
  if (settings.grey_search && light_field.reference().image.channels() > 1)
  {
    view_settings.grey = false;
    preparePlanar(light_field.reference().image, view_settings, views_.reference.pad(), colour_reference_);
  }
}

bool Solver::search(const SolverSettings& settings, SearchIn where, RunContext& context)
{
  CostSettings cost = settings.cost;
  if (views_.reference.channels() == 1)
  {
    cost.truncation = std::max(1, cvRound(GREY_SHARE * static_cast<float>(cost.truncation)));
    cost.unseen_penalty = cvRound(GREY_SHARE * static_cast<float>(cost.unseen_penalty));
  }
  cost.min_seeing_views = std::min(cost.min_seeing_views, static_cast<int>(views_.views.size()));
  if (!computeFirstCosts(settings, cost, where, context))
  {
    return false;
  }
  setPaths(paths_, context);
  aggregate(settings, context);
  if (settings.detect_changes && !acceptFirstMap(where, context))
  {
    return false;
  }
  if (settings.fuse_background)
  {
    fuseBackground(settings, context);
  }
  disparity_.copyTo(first_search_);
  context.save("multiview_first_search", first_search_);
  for (int pass = 0; pass < settings.visibility_passes; ++pass)
  {
    {
      const StageTimer timer(context, "visibility");
      bands_.setAround(disparity_, labels_, BAND_REACH_PX, BAND_MARGIN_LABELS, context.pool);
      surfaces_.warp(disparity_, views_, labels_, context.pool);
    }
    {
      const StageTimer timer(context, "visible_cost");
      cost_builder_.buildFromVisible(views_, labels_, bands_, surfaces_, cost, context.pool, volume_);
      if (settings.fuse_background)
      {
        background_.chargeMoved(context.pool, volume_);
      }
    }
    if (pass + 1 == settings.visibility_passes)
    {
      setPaths(lastPaths(paths_, settings), context);
    }
    aggregate(settings, context);
  }
  return true;
}

void Solver::setPaths(const PathSettings& paths, RunContext& context)
{
  const StageTimer timer(context, "aggregate");
  paths_ = paths;
  // Sixteen bits hold the sums of the paths.
  paths_.small_change_penalty = std::clamp(paths_.small_change_penalty, 1, MAX_STEP);
  paths_.large_change_penalty = std::clamp(paths_.large_change_penalty, 1, MAX_STEP);
  aggregator_.setGuide(guide(), paths_, context.pool);
}

bool Solver::computeFirstCosts(const SolverSettings& settings, const CostSettings& cost, SearchIn where,
                               RunContext& context)
{
  const StageTimer timer(context, "cost");
  if (where == SearchIn::AllLabels)
  {
    bands_.setAll(views_.width(), views_.height(), labels_.count);
  }
  else
  {
    bands_.setAround(disparity_, labels_, FOLLOWED_REACH_PX, FOLLOWED_MARGIN_LABELS, context.pool);
  }
  if (!settings.detect_changes)
  {
    cost_builder_.buildFromArms(views_, labels_, bands_, cost, context.pool, volume_);
    return true;
  }
  changes_.begin(bands_);
  cost_builder_.buildObserved(views_, labels_, bands_, cost, changes_, context.pool, volume_);
  if (where == SearchIn::AllLabels)
  {
    changes_.acceptFull();
    return true;
  }
  if (!changes_.acceptNear(bands_, changed_tiles_))
  {
    return false;
  }
  if (std::any_of(changed_tiles_.begin(), changed_tiles_.end(), [](std::uint8_t tile) { return tile != 0; }))
  {
    cost_builder_.rebuildTiles(views_, labels_, bands_, changed_tiles_, cost, context.pool, volume_);
  }
  return true;
}

bool Solver::acceptFirstMap(SearchIn where, RunContext& context)
{
  const StageTimer timer(context, "cost");
  if (where == SearchIn::AllLabels)
  {
    changes_.acceptFullMap(disparity_, labels_);
    return true;
  }
  return changes_.acceptNearMap(disparity_, labels_);
}

void Solver::fuseBackground(const SolverSettings& settings, RunContext& context)
{
  {
    const StageTimer timer(context, "background");
    background_.prepare(labels_, disparity_, context.pool, volume_);
    cv::swap(disparity_, searched_);
  }
  aggregate(settings, context);
  const StageTimer timer(context, "background");
  cv::swap(disparity_, searched_);
  context.save("multiview_background", searched_);
  background_.fuse(volume_, aggregator_, paths_, searched_, context.pool, disparity_);
}

void Solver::aggregate(const SolverSettings& settings, RunContext& context)
{
  {
    const StageTimer timer(context, "aggregate");
    aggregator_.aggregate(volume_, paths_, context.pool, label_);
  }
  const StageTimer timer(context, "median");
  median_.run(label_, labels_, context.pool, disparity_);
  if (settings.keep_thin_structures)
  {
    label_.convertTo(scratch_, CV_32F, labels_.step_px, labels_.first_px);
    keepThinStructures(guide(), scratch_, context.pool, disparity_);
  }
}

void Solver::refine(const SolverSettings& settings, RunContext& context)
{
  {
    const StageTimer timer(context, "noise");
    measureViewNoise(views_, disparity_, context.pool, noise_);
  }
  SmoothingSettings smoothing = settings.smoothing;
  smoothing.strength *= 1.0F + settings.strength_per_variance * noise_.value_variance;
  if (settings.refinements > 0)
  {
    const StageTimer timer(context, "smooth");
    smoother_.setGuide(guide(), smoothing, context.pool);
  }
  for (int i = 0; i < settings.refinements; ++i)
  {
    linearize(settings, context);
    const StageTimer timer(context, "smooth");
    smoothing.follow_slopes = i + 1 == settings.refinements;
    smoother_.run(linearization_.weight, linearization_.target, smoothing, context.pool, disparity_);
    keepNearLabels(context);
  }
}

/// Where nothing is known and the image cuts a line of pixels off from the others, the equations of the
/// smoothing are singular but for rounding: what leaves the range of the search, or is no number, is as it
/// was searched.
void Solver::keepNearLabels(RunContext& context)
{
  const float low = labels_.first_px - REFINEMENT_REACH_PX;
  const float high = labels_.disparity(static_cast<float>(labels_.count - 1)) + REFINEMENT_REACH_PX;
  context.pool.parallelFor(0, disparity_.rows, ROWS_PER_CHUNK,
                           [&](int first, int last)
                           {
                             for (int y = first; y < last; ++y)
                             {
                               auto* const row = disparity_.ptr<float>(y);
                               const auto* const searched = searched_.ptr<float>(y);
                               for (int x = 0; x < disparity_.cols; ++x)
                               {
                                 const bool kept = row[x] >= low && row[x] <= high;
                                 row[x] = kept ? row[x] : searched[x];
                               }
                             }
                           });
}

void Solver::linearize(const SolverSettings& settings, RunContext& context)
{
  const StageTimer timer(context, "linearize");
  linearizer_.run(views_, disparity_, noise_.local_slope_variance, settings.linearization, context.pool,
                  linearization_);
  discount_.apply(settings.noise_discount, context.pool, linearization_);
}

cv::Mat Solver::filled() const
{
  return findFilled(discount_.share(), disparity_);
}

cv::Mat Solver::unmeasured() const
{
  return findUnmeasured(discount_.share(), disparity_.size());
}

void Solver::rateConfidence(const SolverSettings& settings, RunContext& context)
{
  if (settings.refinements == 0)
  {
    linearize(settings, context);
  }
  context.save("multiview_curvature", linearization_.weight);
  context.save("multiview_residual", linearization_.residual);
  context.save("multiview_disagreement", linearization_.disagreement);
  context.save("multiview_target", linearization_.target);
  const StageTimer timer(context, "confidence");
  estimateConfidence({disparity_, searched_, first_search_, linearization_, settings.noise_sigma},
                     context.pool, confidence_);
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
