#include "core/multiview/multiview_estimator.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "core/light_field/half_resolution.h"
#include "core/light_field/spread_views.h"
#include "core/light_field/view_set.h"
#include "core/multiview/expected_stages.h"
#include "core/multiview/maps/left_right_check.h"
#include "core/multiview/maps/upsampling.h"
#include "core/multiview/pair.h"
#include "core/multiview/scene_measurement.h"
#include "core/multiview/sequence.h"
#include "core/multiview/solver.h"
#include "core/multiview/solver_settings.h"
#include "light_field_depth/core/exposure.h"
#include "light_field_depth/core/registration.h"

namespace light_field_depth
{
namespace
{
using multiview::SceneMeasures;
using multiview::SolverSettings;

/// With at most this many views in the row and column of the reference, all views are used.
constexpr int FEW_VIEWS = 6;

/// Smaller views are not halved: half of it is the least that makeLightField() takes.
constexpr int MIN_HALVED_SIDE_PX = 32;
/// As accurate as four, which take longer; two are worse (docs/experiments.md).
constexpr int FAST_VIEWS_PER_ARM = 3;
/// Of disparities that the outermost view sees four times as large: more than that among 3 x 3 pixels is an
/// edge.
constexpr double EDGE_JUMP_PX = 0.2;

/// Maps of other views are refined less often, which takes off a tenth of their time and makes the cloud of
/// `balanced` better at edges: of the demo 0.078 instead of 0.089 % of the points fly, 73.2 instead of 72.6 %
/// of what is seen is there within 0.25 %. Not at all: antinous keeps 87.5 instead of 90.4 % of the
/// reference.
constexpr int SPARED_REFINEMENTS = 1;

bool isLarge(const LightField& light_field)
{
  return light_field.size().area() > MultiviewEstimator::LARGE_PIXELS;
}

/// Marks more pixels as filled. @param where CV_8UC1; empty: all
void markFilled(DisparityEstimate& estimate, const cv::Mat& where = {})
{
  estimate.filled.setTo(255, where);
  estimate.unmeasured.setTo(255, where);
  estimate.held.setTo(0, where);
}

/// The map of a view as the cloud takes it: the confidence is 0 where no view measured the disparity, and
/// that of what a plane holds is apart.
ViewDisparity ofView(std::size_t view_index, const DisparityEstimate& estimate)
{
  ViewDisparity map{view_index, estimate.disparity, estimate.confidence.clone(), {}};
  if (!estimate.held.empty() && cv::countNonZero(estimate.held) > 0)
  {
    map.held = cv::Mat::zeros(estimate.confidence.size(), CV_32FC1);
    estimate.confidence.copyTo(map.held, estimate.held);
  }
  if (!estimate.unmeasured.empty())
  {
    map.confidence.setTo(0.0F, estimate.unmeasured);
  }
  return map;
}

/// Where a light field has the view at a place of the grid.
std::size_t indexOf(const LightField& light_field, const GridPosition& grid)
{
  const auto found = std::find_if(light_field.views.begin(), light_field.views.end(),
                                  [&](const View& view) { return view.grid == grid; });
  return static_cast<std::size_t>(found - light_field.views.begin());
}

/// Of some views, said of all.
Registration ofAllViews(const Registration& registration, const LightField& chosen, const LightField& all)
{
  Registration result = registration;
  if (registration.views.empty())
  {
    return result;
  }
  result.views.assign(all.views.size(), {});
  for (std::size_t i = 0; i < chosen.views.size(); ++i)
  {
    result.views[indexOf(all, chosen.views[i].grid)] = registration.views[i];
  }
  return result;
}

/// The inverse.
Registration ofChosenViews(const Registration& registration, const LightField& all, const LightField& chosen)
{
  Registration result = registration;
  if (registration.views.empty())
  {
    return result;
  }
  result.views.clear();
  for (const View& view : chosen.views)
  {
    result.views.push_back(registration.views[indexOf(all, view.grid)]);
  }
  return result;
}

/// The views of a light field that are solved, with 8 bits a channel.
LightField chosenViews(const LightField& light_field, ViewSelection wanted)
{
  return toEightBit(selectViews(light_field, selectionOf(light_field, wanted)));
}

}  // namespace

ViewSelection selectionOf(const LightField& light_field, ViewSelection wanted)
{
  if (wanted != ViewSelection::Auto)
  {
    return wanted;
  }
  const GridPosition centre = light_field.reference().grid;
  const auto on_cross = std::count_if(
      light_field.views.begin(), light_field.views.end(),
      [&](const View& view) { return view.grid.row == centre.row || view.grid.column == centre.column; });
  return on_cross > FEW_VIEWS ? ViewSelection::Cross : ViewSelection::All;
}

/// What lives from frame to frame. `sequence` and `solver` carry the last frame's result into the next one;
/// the others only keep memory that the next frame uses again.
struct MultiviewEstimator::FrameMemory
{
  multiview::Sequence sequence;     ///< whether the next frame may follow, and what was measured on the first
  multiview::Solver solver;         ///< its last map is where a frame that follows is searched
  multiview::Solver coarse_solver;  ///< of large light fields at half the resolution
  multiview::HalfResolution half;   ///< what the preset `fast` solves
  multiview::SceneMeasurement measurement;
  multiview::HalfResolution coarse_half;     ///< what coarse_solver solves
  multiview::HalfResolution turned_half;     ///< a pair as its other view sees it
  multiview::HalfResolution turned_quarter;  ///< the same of a large pair
  multiview::Solver turned_solver;
  std::unique_ptr<MultiviewEstimator> other_views;  ///< solves maps of other views for the dense cloud
};

MultiviewEstimator::MultiviewEstimator(MultiviewOptions options)
    : options_(options), memory_(std::make_unique<FrameMemory>())
{
}

MultiviewEstimator::~MultiviewEstimator() = default;

DisparityEstimate MultiviewEstimator::estimate(const LightField& light_field, const EstimateRequest& request,
                                               RunContext& context)
{
  const LightField chosen = chosenViews(light_field, request.views);
  const bool halved = options_.preset == MultiviewPreset::Fast &&
                      std::min(chosen.size().width, chosen.size().height) >= MIN_HALVED_SIDE_PX;
  DisparityEstimate estimate;
  if (halved)
  {
    const LightField half = reduced(chosen, context);
    solve(half, request, context, estimate);
    estimate.views_used = half.views.size();
    upsample(chosen, context, estimate);
  }
  else
  {
    solve(chosen, request, context, estimate);
    estimate.views_used = chosen.views.size();
  }
  estimate.registration = ofAllViews(estimate.registration, chosen, light_field);
  if (request.solved_maps > 0)
  {
    estimate.view_disparities = {ofView(light_field.reference_index, estimate)};
    std::vector<ViewDisparity> others = solveOtherViews(light_field, request, estimate, context);
    std::move(others.begin(), others.end(), std::back_inserter(estimate.view_disparities));
  }
  return estimate;
}

std::vector<ViewDisparity> MultiviewEstimator::solveOtherViews(const LightField& light_field,
                                                               const EstimateRequest& request,
                                                               const DisparityEstimate& estimate,
                                                               RunContext& context)
{
  std::vector<ViewDisparity> maps;
  if (request.solved_maps < 2)
  {
    return maps;
  }
  const StageTimer timer(context, "view_maps");
  const LightField given = chosenViews(light_field, request.views);
  const LightField chosen =
      correctRegistration(given, ofChosenViews(estimate.registration, light_field, given), context.pool);
  const std::vector<std::size_t> views = spreadViews(chosen, request.solved_maps);
  if (!memory_->other_views)
  {
    memory_->other_views = std::make_unique<MultiviewEstimator>();
  }
  MultiviewOptions options = options_;
  options.temporal = false;
  options.registration = false;  // they stand where they are
  options.refinements = std::max(withPresetNumbers(options_).refinements - SPARED_REFINEMENTS, 1);
  memory_->other_views->setOptions(options);
  EstimateRequest alone;
  alone.disparity_range = estimate.range;
  alone.views = ViewSelection::All;
  RunContext apart(context.pool);
  for (std::size_t i = 1; i < views.size(); ++i)
  {
    const DisparityEstimate other = memory_->other_views->estimate(turnedTo(chosen, views[i]), alone, apart);
    maps.push_back(ofView(indexOf(light_field, chosen.views[views[i]].grid), other));
  }
  return maps;
}

LightField MultiviewEstimator::reduced(const LightField& chosen, RunContext& context)
{
  const StageTimer timer(context, "halve");
  return memory_->half.reduce(multiview::withThinnedArms(chosen, FAST_VIEWS_PER_ARM), context.pool);
}

void MultiviewEstimator::solve(const LightField& views, const EstimateRequest& request, RunContext& context,
                               DisparityEstimate& estimate)
{
  context.expect(multiview::expectedStages(options_, isLarge(views), multiview::isPair(views)));
  if (!options_.temporal)
  {
    memory_->sequence.forget();  // no later frame may follow what the solver is going to hold
  }
  else if (follow(views, request, context, estimate))
  {
    return;
  }
  SceneMeasures measures;
  const LightField chosen = memory_->measurement.measure(views, request, options_, context, measures);
  const double unit = multiview::solverUnit(chosen);
  const bool large = isLarge(chosen);
  if (large)
  {
    solveCoarseToFine(chosen, measures, context);
  }
  else
  {
    const SolverSettings settings = multiview::solverSettings(options_, measures, chosen, unit);
    memory_->solver.run(multiview::inSolverUnit(chosen, unit), settings, context);
  }
  estimate.range = measures.range;
  estimate.registration = measures.registration;
  keepResult(unit, estimate);
  confirmPair(chosen, measures, context, estimate);
  if (options_.temporal && !large)
  {
    memory_->sequence.begin(std::move(measures));
  }
}

/// All labels at half the resolution, and those about the result at the full one: the memory of a large light
/// field does not grow with its labels.
void MultiviewEstimator::solveCoarseToFine(const LightField& chosen, const SceneMeasures& measures,
                                           RunContext& context)
{
  MultiviewOptions options = options_;
  options.temporal = false;
  MultiviewOptions coarse_options = options;
  coarse_options.refinements = std::min(withPresetNumbers(options).refinements, 1);
  const LightField half = memory_->coarse_half.reduce(chosen, context.pool);
  const double half_unit = multiview::solverUnit(half);
  multiview::Solver& coarse_solver = memory_->coarse_solver;
  coarse_solver.run(multiview::inSolverUnit(half, half_unit),
                    multiview::solverSettings(coarse_options, measures, half, half_unit), context);
  DisparityEstimate coarse;
  coarse_solver.disparity().convertTo(coarse.disparity, CV_32F, 1.0 / half_unit);
  coarse.confidence = coarse_solver.confidence();
  upsample(chosen, context, coarse);
  const double unit = multiview::solverUnit(chosen);
  memory_->solver.runNear(multiview::inSolverUnit(chosen, unit),
                          multiview::solverSettings(options, measures, chosen, unit), coarse.disparity * unit,
                          context);
}

/// The frame with what was measured on the last one that was searched in full.
/// @return false if it does not follow, or shows another scene
bool MultiviewEstimator::follow(const LightField& views, const EstimateRequest& request, RunContext& context,
                                DisparityEstimate& estimate)
{
  const SceneMeasures* const measures = memory_->sequence.follow(views, {options_, request.disparity_range});
  if (measures == nullptr)
  {
    return false;
  }
  SceneMeasures here = *measures;
  LightField chosen;
  {
    const StageTimer timer(context, "exposure");
    chosen = compensateExposure(views, here.exposures, context.pool);
  }
  {
    const StageTimer timer(context, "registration");
    chosen = correctRegistration(chosen, here.registration, context.pool);
  }
  {
    const StageTimer timer(context, "noise");
    here.noise_sigma = multiview::measureNoise(chosen, here.range, context.pool);
  }
  const double unit = multiview::solverUnit(chosen);
  if (!memory_->solver.follow(multiview::inSolverUnit(chosen, unit),
                              multiview::solverSettings(options_, here, chosen, unit), context))
  {
    return false;
  }
  estimate.range = here.range;
  estimate.registration = here.registration;
  keepResult(unit, estimate);
  confirmPair(chosen, here, context, estimate);
  memory_->sequence.keep();
  return true;
}

void MultiviewEstimator::keepResult(double unit, DisparityEstimate& estimate) const
{
  memory_->solver.disparity().convertTo(estimate.disparity, CV_32F, 1.0 / unit);
  estimate.confidence = memory_->solver.confidence().clone();
  estimate.filled = memory_->solver.filled();
  estimate.unmeasured = memory_->solver.unmeasured();
  estimate.held = memory_->solver.held().clone();
  if (estimate.range.min >= estimate.range.max)
  {
    // No disparity had any support: the views are of nothing, of noise or not of one scene, and agree by
    // smoothness alone.
    estimate.confidence.setTo(0.0F);
    markFilled(estimate);
  }
}

/// Where only two views tell the depth, a map of the other view tells which pixels both agree on; the rest is
/// filled from behind. The other map is made at half the resolution by a single search, which is enough to
/// tell: a second search that knows who sees what pulls the edges of both maps to where they agree, so that
/// 0.80 instead of 0.47 % of ETH3D playground are off by more than 4 px, and 10.9 instead of 10.2 % of
/// Middlebury Art.
void MultiviewEstimator::confirmPair(const LightField& chosen, const SceneMeasures& measures,
                                     RunContext& context, DisparityEstimate& estimate)
{
  const cv::Size size = chosen.size();
  if (!multiview::isPair(chosen) || std::min(size.width, size.height) < MIN_HALVED_SIDE_PX)
  {
    return;
  }
  MultiviewOptions options = options_;
  options.temporal = false;
  options.visibility_passes = 0;
  LightField turned = memory_->turned_half.reduceInColour(multiview::turnedRound(chosen), context.pool);
  if (isLarge(chosen))
  {
    turned = memory_->turned_quarter.reduceInColour(turned, context.pool);
  }
  const double unit = multiview::solverUnit(turned);
  multiview::Solver& solver = memory_->turned_solver;
  const cv::Mat turned_disparity =
      solver.search(multiview::inSolverUnit(turned, unit),
                    multiview::solverSettings(options, measures, turned, unit), context) /
      unit;
  const StageTimer timer(context, "left_right_check");
  const View& other = multiview::otherView(chosen);
  multiview::LeftRightSettings check;
  if (isLarge(chosen))
  {
    check.max_distance_px *= 2.0F;  // a quarter of the resolution has labels twice as far apart
  }
  const cv::Mat unconfirmed =
      multiview::findUnconfirmed(estimate.disparity, other, turned_disparity, check, context.pool);
  multiview::BackgroundFillSettings fill;
  if (options_.preset == MultiviewPreset::Realtime)
  {
    // A fifth of the samples: a third of the time of the median, and the same share of wrong pixels to 0.2 %.
    fill.radius_px = 8;
    fill.stride_px = 4;
    // The rest in 0.4 of its time, for 13.4 instead of 13.2 % of Art off by more than 4 px.
    fill.max_colour_step = 8;
  }
  multiview::fillFromBackground(chosen.reference().image, unconfirmed,
                                std::abs(other.steps.y) > std::abs(other.steps.x), fill, context.pool,
                                estimate.disparity);
  estimate.confidence.setTo(0.0F, unconfirmed);
  markFilled(estimate, unconfirmed);
}

void MultiviewEstimator::upsample(const LightField& light_field, RunContext& context,
                                  DisparityEstimate& estimate)
{
  const cv::Mat& image = light_field.reference().image;
  const auto edge_jump = static_cast<float>(EDGE_JUMP_PX / multiview::solverUnit(light_field));
  const StageTimer timer(context, "upsample");
  cv::Mat disparity;
  cv::Mat confidence;
  multiview::upsample(estimate.disparity, estimate.confidence, edge_jump, image, context.pool, disparity,
                      confidence);
  estimate.disparity = disparity;
  estimate.confidence = confidence;
  for (cv::Mat* const mask : {&estimate.filled, &estimate.unmeasured, &estimate.held})
  {
    if (!mask->empty())
    {
      cv::Mat full;
      cv::resize(*mask, full, image.size(), 0.0, 0.0, cv::INTER_NEAREST);
      *mask = full;
    }
  }
}

}  // namespace light_field_depth
