#include "core/multiview/multiview_estimator.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "core/light_field/half_resolution.h"
#include "core/light_field/reach.h"
#include "core/light_field/view_set.h"
#include "core/multiview/maps/left_right_check.h"
#include "core/multiview/maps/upsampling.h"
#include "core/multiview/maps/view_maps.h"
#include "core/multiview/noise.h"
#include "core/multiview/pair.h"
#include "core/multiview/sequence.h"
#include "core/multiview/solver.h"
#include "core/preprocess/even_exposure.h"
#include "core/preprocess/view_noise.h"
#include "light_field_depth/core/disparity_range.h"
#include "light_field_depth/core/exposure.h"
#include "light_field_depth/core/noise_estimate.h"
#include "light_field_depth/core/registration.h"

namespace light_field_depth
{
namespace
{
using multiview::SceneMeasures;
using multiview::SolverSettings;

/// The settings are meant for this distance of the outermost view, in grid steps.
constexpr double REFERENCE_BASELINE = 4.0;
/// Above this many pixels the search goes from coarse to fine.
constexpr int LARGE_PIXELS = 1'000'000;
/// With at most this many views in the row and column of the reference, all views are used.
constexpr int FEW_VIEWS = 6;

/// Smaller views are not halved.
constexpr int MIN_HALVED_SIDE_PX = 32;
/// Of half the resolution: smaller views are not halved again to measure the scene.
constexpr int MIN_QUARTERED_SIDE_PX = 96;
constexpr int FAST_VIEWS_PER_ARM = 3;
/// So few views are measured at half the resolution in no time. They stand far apart more often than others,
/// and a range that is wider than it has to be lets repeated patterns match a period too far.
constexpr std::size_t MAX_VIEWS_MEASURED_AT_HALF_RESOLUTION = 9;
/// The searches for exposure and range halve larger views at least once, each for itself.
constexpr int MIN_LONGER_SIDE_MEASURED_HALVED_PX = 384;
constexpr int MIN_SHORTER_SIDE_MEASURED_HALVED_PX = 64;

bool isMeasuredHalved(const cv::Size& size)
{
  return std::max(size.width, size.height) >= MIN_LONGER_SIDE_MEASURED_HALVED_PX &&
         std::min(size.width, size.height) >= MIN_SHORTER_SIDE_MEASURED_HALVED_PX;
}

bool isLarge(const LightField& light_field)
{
  return light_field.size().area() > LARGE_PIXELS;
}

/// Of a point at infinity, where no shear and no guess hides it.
std::optional<float> farthestDisparity(const LightField& light_field)
{
  if (light_field.calibration && light_field.calibration->disparity_offset_px == 0.0)
  {
    return 0.0F;
  }
  return std::nullopt;
}

/// Pixels of disparity of the solver in one of the light field: with the solver's, the outermost view has
/// REFERENCE_BASELINE.
double solverUnit(const LightField& light_field)
{
  double widest = 0.0;
  for (const View& view : light_field.views)
  {
    widest = std::max({widest, std::abs(view.steps.x), std::abs(view.steps.y)});
  }
  return widest / REFERENCE_BASELINE;
}

/// The light field with the solver's unit of disparity.
LightField inSolverUnit(LightField light_field, double unit)
{
  for (View& view : light_field.views)
  {
    view.steps *= 1.0 / unit;
  }
  return light_field;
}

/// What one image tells, unless differences of views tell much more: noise that demosaicing, denoising or
/// compression has correlated from pixel to pixel looks like texture in one image. The search and the
/// windows average less of it than of white noise of the same strength, so it counts for more.
float measuredNoise(const LightField& light_field, const DisparityRange& range, ThreadPool& pool)
{
  constexpr float least_sigma = 0.85F;  // below it views count as clean
  constexpr float least_ratio = 1.5F;   // the two measures agree to a fifth on white noise
  constexpr float correlated = 1.3F;
  const float of_image = estimateNoise(light_field.reference().image);
  const float of_views = multiview::estimateNoiseOfViews(light_field, range, pool);
  const bool is_correlated = of_views > least_sigma && of_views > least_ratio * of_image;
  return is_correlated ? std::max(of_image, correlated * of_views) : of_image;
}

/// @param light_field in pixels of disparity, of which the solver has `unit` times as many
SolverSettings solverSettings(const MultiviewOptions& given, const SceneMeasures& measures,
                              const LightField& light_field, double unit)
{
  const MultiviewOptions options = withPresetNumbers(given);
  SolverSettings settings;
  settings.range = {static_cast<float>(measures.range.min * unit),
                    static_cast<float>(measures.range.max * unit)};
  settings.label_step_px = options.label_step_px;
  settings.grey_search =
      options.preset == MultiviewPreset::Realtime || options.preset == MultiviewPreset::Fast;
  settings.paths.small_change_penalty = options.small_change_penalty;
  settings.paths.large_change_penalty = options.large_change_penalty;
  settings.visibility_passes = options.visibility_passes;
  settings.fuse_background = options.background_fusion && !settings.grey_search;
  settings.keep_thin_structures = options.thin_structures;
  settings.decide_boundary_pixels = options.boundary_pixels;
  settings.refinements = options.refinements;
  settings.linearization.brightness_slope = options.brightness_slope;
  settings.smoothing.strength = options.refinement_smoothness;
  settings.detect_changes = options.temporal;
  adaptToNoise(measures.noise_sigma, settings);
  if (multiview::isPair(light_field))
  {
    multiview::adaptToPair(settings);
  }
  return settings;
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
  multiview::HalfResolution quarter;         ///< what the preset `fast` measures
  multiview::HalfResolution measured_half;   ///< what the others measure
  multiview::HalfResolution coarse_half;     ///< what coarse_solver solves
  multiview::HalfResolution turned_half;     ///< a pair as its other view sees it
  multiview::HalfResolution turned_quarter;  ///< the same of a large pair
  multiview::Solver turned_solver;
  std::vector<ViewDisparity> view_maps;
};

MultiviewEstimator::MultiviewEstimator(MultiviewOptions options)
    : options_(options), memory_(std::make_unique<FrameMemory>())
{
}

MultiviewEstimator::~MultiviewEstimator() = default;

DisparityEstimate MultiviewEstimator::estimate(const LightField& light_field, const EstimateRequest& request,
                                               RunContext& context)
{
  const LightField chosen = toEightBit(selectViews(light_field, selectionOf(light_field, request.views)));
  const bool halved = options_.preset == MultiviewPreset::Fast &&
                      std::min(chosen.size().width, chosen.size().height) >= MIN_HALVED_SIDE_PX;
  DisparityEstimate estimate;
  if (halved)
  {
    const LightField half = reduced(chosen, context);
    solve(half, request, context, estimate);
    estimate.views_used = half.views.size();
    upsample(chosen.reference().image, context, estimate);
  }
  else
  {
    solve(chosen, request, context, estimate);
    estimate.views_used = chosen.views.size();
  }
  if (request.view_disparities)
  {
    const StageTimer timer(context, "view_maps");
    multiview::warpToViews(light_field, estimate.disparity, estimate.confidence, context.pool,
                           memory_->view_maps);
    estimate.view_disparities = memory_->view_maps;
  }
  return estimate;
}

LightField MultiviewEstimator::reduced(const LightField& chosen, RunContext& context)
{
  const StageTimer timer(context, "halve");
  return memory_->half.reduce(multiview::withThinnedArms(chosen, FAST_VIEWS_PER_ARM), context.pool);
}

void MultiviewEstimator::solve(const LightField& views, const EstimateRequest& request, RunContext& context,
                               DisparityEstimate& estimate)
{
  if (!options_.temporal)
  {
    memory_->sequence.forget();  // no later frame may follow what the solver is going to hold
  }
  else if (follow(views, request, context, estimate))
  {
    return;
  }
  SceneMeasures measures;
  const LightField chosen = options_.preset == MultiviewPreset::Fast
                                ? measureQuickly(views, request, context, measures)
                                : measure(views, request, context, measures);
  const double unit = solverUnit(chosen);
  const bool large = isLarge(chosen);
  if (large)
  {
    solveCoarseToFine(chosen, measures, context);
  }
  else
  {
    const SolverSettings settings = solverSettings(options_, measures, chosen, unit);
    memory_->solver.run(inSolverUnit(chosen, unit), settings, context);
  }
  estimate.range = measures.range;
  keepResult(unit, estimate);
  confirmPair(chosen, measures, context, estimate);
  if (options_.temporal && !large)
  {
    memory_->sequence.begin(std::move(measures));
  }
}

/// @return the views, made equal in exposure
LightField MultiviewEstimator::measure(const LightField& views, const EstimateRequest& request,
                                       RunContext& context, SceneMeasures& measures)
{
  const bool halved = isMeasuredHalved(views.size());
  DisparityRangeOptions range_options;
  range_options.max_displacement_px *= halved ? 0.5F : 1.0F;
  range_options.farthest_px = farthestDisparity(views);
  LightField chosen;
  LightField small;
  {
    const StageTimer timer(context, "exposure");
    small = halved ? memory_->measured_half.reduceInColour(views, context.pool) : views;
    measures.exposures = estimateExposure(small, context.pool, range_options.max_displacement_px);
    chosen = compensateExposure(views, measures.exposures, context.pool);
    small = compensateExposure(small, measures.exposures, context.pool);
  }
  {
    const StageTimer timer(context, "range");
    measures.range = request.disparity_range ? *request.disparity_range
                                             : findDisparityRange(small, context.pool, range_options);
    checkReach(measures.range, views);
  }
  if (options_.registration)
  {
    const StageTimer timer(context, "registration");
    RegistrationOptions registration_options;
    registration_options.pixel_size = halved ? 2.0 : 1.0;
    measures.registration = estimateRegistration(small, measures.range, context.pool, registration_options);
    chosen = correctRegistration(chosen, measures.registration, context.pool);
  }
  const StageTimer timer(context, "noise");
  measures.noise_sigma = measuredNoise(chosen, measures.range, context.pool);
  return chosen;
}

/// The same from views of a quarter of the resolution, and without a search for small differences in
/// exposure, where there are many views.
/// @param views of half the resolution
LightField MultiviewEstimator::measureQuickly(const LightField& views, const EstimateRequest& request,
                                              RunContext& context, SceneMeasures& measures)
{
  const cv::Size size = views.size();
  if (std::min(size.width, size.height) < MIN_QUARTERED_SIDE_PX ||
      views.views.size() <= MAX_VIEWS_MEASURED_AT_HALF_RESOLUTION)
  {
    return measure(views, request, context, measures);
  }
  LightField chosen = views;
  LightField quarter;
  measures.exposures.resize(views.views.size());
  {
    const StageTimer timer(context, "exposure");
    quarter = memory_->quarter.reduce(views, context.pool);
    if (!multiview::looksEvenlyExposed(quarter))
    {
      measures.exposures = estimateExposure(views, context.pool);
      chosen = compensateExposure(views, measures.exposures, context.pool);
      quarter = memory_->quarter.reduce(chosen, context.pool);
    }
  }
  {
    const StageTimer timer(context, "range");
    DisparityRangeOptions range_options;
    range_options.max_displacement_px *= 0.25F;
    measures.range = request.disparity_range ? *request.disparity_range
                                             : findDisparityRange(quarter, context.pool, range_options);
    checkReach(measures.range, views);
  }
  const StageTimer timer(context, "noise");
  measures.noise_sigma = measuredNoise(chosen, measures.range, context.pool);
  return chosen;
}

/// All labels at half the resolution, and those about the result at the full one: the memory of a large light
/// field does not grow with its labels.
void MultiviewEstimator::solveCoarseToFine(const LightField& chosen, const SceneMeasures& measures,
                                           RunContext& context)
{
  MultiviewOptions options = withPresetNumbers(options_);
  options.temporal = false;
  MultiviewOptions coarse_options = options;
  coarse_options.refinements = std::min(options.refinements, 1);
  const LightField half = memory_->coarse_half.reduce(chosen, context.pool);
  const double half_unit = solverUnit(half);
  multiview::Solver& coarse_solver = memory_->coarse_solver;
  coarse_solver.run(inSolverUnit(half, half_unit), solverSettings(coarse_options, measures, half, half_unit),
                    context);
  DisparityEstimate coarse;
  coarse_solver.disparity().convertTo(coarse.disparity, CV_32F, 1.0 / half_unit);
  coarse.confidence = coarse_solver.confidence();
  upsample(chosen.reference().image, context, coarse);
  const double unit = solverUnit(chosen);
  memory_->solver.runNear(inSolverUnit(chosen, unit), solverSettings(options, measures, chosen, unit),
                          coarse.disparity * unit, context);
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
    here.noise_sigma = measuredNoise(chosen, here.range, context.pool);
  }
  const double unit = solverUnit(chosen);
  if (!memory_->solver.follow(inSolverUnit(chosen, unit), solverSettings(options_, here, chosen, unit),
                              context))
  {
    return false;
  }
  estimate.range = here.range;
  keepResult(unit, estimate);
  confirmPair(chosen, here, context, estimate);
  memory_->sequence.keep();
  return true;
}

void MultiviewEstimator::keepResult(double unit, DisparityEstimate& estimate) const
{
  memory_->solver.disparity().convertTo(estimate.disparity, CV_32F, 1.0 / unit);
  estimate.confidence = memory_->solver.confidence().clone();
}

/// Where only two views tell the depth, a map of the other view tells which pixels both agree on; the rest is
/// filled from behind. The other map is made at half the resolution, which is enough to tell.
void MultiviewEstimator::confirmPair(const LightField& chosen, const SceneMeasures& measures,
                                     RunContext& context, DisparityEstimate& estimate)
{
  const cv::Size size = chosen.size();
  if (!multiview::isPair(chosen) || std::min(size.width, size.height) < MIN_HALVED_SIDE_PX)
  {
    return;
  }
  MultiviewOptions options = withPresetNumbers(options_);
  options.temporal = false;
  options.refinements = std::min(options.refinements, 1);
  LightField turned = memory_->turned_half.reduceInColour(multiview::turnedRound(chosen), context.pool);
  if (isLarge(chosen))
  {
    turned = memory_->turned_quarter.reduceInColour(turned, context.pool);
  }
  const double unit = solverUnit(turned);
  multiview::Solver& solver = memory_->turned_solver;
  solver.run(inSolverUnit(turned, unit), solverSettings(options, measures, turned, unit), context);
  const StageTimer timer(context, "left_right_check");
  const View& other = multiview::otherView(chosen);
  const cv::Mat unconfirmed =
      multiview::findUnconfirmed(estimate.disparity, other, solver.disparity() / unit, {}, context.pool);
  multiview::fillFromBackground(chosen.reference().image, unconfirmed,
                                std::abs(other.steps.y) > std::abs(other.steps.x), {}, context.pool,
                                estimate.disparity);
  estimate.confidence.setTo(0.0F, unconfirmed);
}

void MultiviewEstimator::upsample(const cv::Mat& image, RunContext& context, DisparityEstimate& estimate)
{
  const StageTimer timer(context, "upsample");
  cv::Mat disparity;
  cv::Mat confidence;
  multiview::upsample(estimate.disparity, estimate.confidence, image, context.pool, disparity, confidence);
  estimate.disparity = disparity;
  estimate.confidence = confidence;
}

}  // namespace light_field_depth
