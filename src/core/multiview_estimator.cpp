#include "light_field_depth/core/multiview_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/multiview/cost_volume.h"
#include "light_field_depth/core/multiview/edge_aware_smoothing.h"
#include "light_field_depth/core/multiview/edge_side.h"
#include "light_field_depth/core/multiview/label_space.h"
#include "light_field_depth/core/multiview/path_aggregation.h"
#include "light_field_depth/core/multiview/refinement.h"
#include "light_field_depth/core/multiview/view_set.h"
#include "light_field_depth/core/multiview/visibility.h"

namespace light_field_depth
{
namespace
{
using multiview::LabelSpace;
using multiview::ViewSet;

/// The settings are meant for this distance of the outermost view, in grid steps.
constexpr double REFERENCE_BASELINE = 4.0;
constexpr int MAX_LABELS = 240;
constexpr int MEDIAN_SIZE = 5;
/// With fewer other views in the row and column of the reference, all views are used.
constexpr std::size_t FEW_VIEWS = 6;

constexpr std::array<std::pair<MultiviewPreset, const char*>, 3> PRESET_NAMES = {{
    {MultiviewPreset::Quality, "quality"},
    {MultiviewPreset::Balanced, "balanced"},
    {MultiviewPreset::Realtime, "realtime"},
}};

LightField chosenViews(const LightField& light_field, ViewSelection selection)
{
  if (selection != ViewSelection::Auto)
  {
    return selectViews(light_field, selection);
  }
  const GridPosition centre = light_field.reference().grid;
  const auto on_cross = std::count_if(
      light_field.views.begin(), light_field.views.end(),
      [&](const View& view) { return view.grid.row == centre.row || view.grid.column == centre.column; });
  return static_cast<std::size_t>(on_cross) > FEW_VIEWS ? selectViews(light_field, ViewSelection::Cross)
                                                        : light_field;
}

double widestBaseline(const LightField& light_field)
{
  double widest = 0.0;
  for (const View& view : light_field.views)
  {
    widest = std::max(widest, std::hypot(view.steps.x, view.steps.y));
  }
  return widest;
}

/// The light field with the unit of disparity changed so that the outermost view has REFERENCE_BASELINE.
LightField scaledSteps(LightField light_field, double scale)
{
  for (View& view : light_field.views)
  {
    view.steps *= 1.0 / scale;
  }
  return light_field;
}

void labelsToDisparity(const cv::Mat& label, const LabelSpace& labels, cv::Mat& disparity)
{
  label.convertTo(disparity, CV_32F, labels.step_px, labels.first_px);
}

}  // namespace

std::string toString(MultiviewPreset preset)
{
  const auto* const found = std::find_if(PRESET_NAMES.begin(), PRESET_NAMES.end(),
                                         [&](const auto& entry) { return entry.first == preset; });
  return found->second;
}

MultiviewPreset multiviewPresetFromString(const std::string& name)
{
  const auto* const found = std::find_if(PRESET_NAMES.begin(), PRESET_NAMES.end(),
                                         [&](const auto& entry) { return name == entry.second; });
  if (found == PRESET_NAMES.end())
  {
    throw InputError("There is no preset '" + name + "'; choose quality, balanced or realtime.");
  }
  return found->first;
}

std::vector<std::string> validate(const MultiviewOptions& options)
{
  std::vector<std::string> problems;
  const auto require = [&](bool good, const std::string& field, double value, const std::string& limits)
  {
    if (!good)
    {
      problems.push_back("multiview." + field + " is " + std::to_string(value) + "; it must be " + limits +
                         ".");
    }
  };
  require(options.label_step_px >= 0.03125F && options.label_step_px <= 1.0F, "label_step_px",
          options.label_step_px, "between 1/32 and 1 px");
  require(options.small_change_penalty >= 1 && options.small_change_penalty <= 1000, "small_change_penalty",
          options.small_change_penalty, "between 1 and 1000");
  require(options.large_change_penalty >= 1 && options.large_change_penalty <= 10000, "large_change_penalty",
          options.large_change_penalty, "between 1 and 10000");
  require(options.visibility_passes >= 0 && options.visibility_passes <= 5, "visibility_passes",
          options.visibility_passes, "between 0 and 5");
  require(options.refinements >= 0 && options.refinements <= 10, "refinements", options.refinements,
          "between 0 and 10");
  require(options.refinement_smoothness > 0.0F && options.refinement_smoothness <= 1e6F,
          "refinement_smoothness", options.refinement_smoothness, "positive and at most 1000000");
  return problems;
}

/// What is kept from frame to frame.
struct MultiviewEstimator::Buffers
{
  ViewSet views;
  multiview::CostVolumeBuilder cost_builder;
  multiview::CostVolume volume;
  multiview::PathAggregator aggregator;
  multiview::VisibleSurfaces surfaces;
  multiview::Linearizer linearizer;
  multiview::Linearization linearization;
  multiview::EdgeAwareSmoother smoother;
  cv::Mat label;
  cv::Mat disparity;
  cv::Mat filtered;
};

MultiviewEstimator::MultiviewEstimator(MultiviewOptions options)
    : options_(options), buffers_(std::make_unique<Buffers>())
{
}

MultiviewEstimator::~MultiviewEstimator() = default;

DisparityEstimate MultiviewEstimator::estimate(const LightField& light_field, const EstimateRequest& request,
                                               RunContext& context)
{
  Buffers& work = *buffers_;
  const LightField chosen = toEightBit(chosenViews(light_field, request.views));
  if (!request.disparity_range)
  {
    throw InputError("The multiview method needs a disparity_range.");
  }
  const double unit = widestBaseline(chosen) / REFERENCE_BASELINE;
  const LightField field = scaledSteps(chosen, unit);
  const DisparityRange range{static_cast<float>(request.disparity_range->min * unit),
                             static_cast<float>(request.disparity_range->max * unit)};
  const LabelSpace labels = multiview::makeLabelSpace(range, options_.label_step_px, MAX_LABELS);
  {
    const StageTimer timer(context, "prepare");
    multiview::ViewSetSettings settings;
    settings.range = {labels.disparity(0.0F), labels.disparity(static_cast<float>(labels.count - 1))};
    multiview::prepareViews(field, settings, context.pool, work.views);
  }
  multiview::CostSettings cost_settings;
  cost_settings.min_seeing_views =
      std::min(cost_settings.min_seeing_views, static_cast<int>(work.views.views.size()));
  multiview::PathSettings path_settings;
  path_settings.small_step = options_.small_change_penalty;
  path_settings.large_step = options_.large_change_penalty;
  const auto search = [&]
  {
    {
      const StageTimer timer(context, "aggregate");
      work.aggregator.aggregate(work.volume, work.views.reference, path_settings, context.pool, work.label);
    }
    const StageTimer timer(context, "median");
    cv::medianBlur(work.label, work.filtered, MEDIAN_SIZE);
    labelsToDisparity(work.filtered, labels, work.disparity);
  };
  {
    const StageTimer timer(context, "cost");
    work.cost_builder.buildFromArms(work.views, labels, cost_settings, context.pool, work.volume);
  }
  search();
  for (int pass = 0; pass < options_.visibility_passes; ++pass)
  {
    {
      const StageTimer timer(context, "visibility");
      work.surfaces.warp(work.disparity, work.views, labels, context.pool);
    }
    {
      const StageTimer timer(context, "visible cost");
      work.cost_builder.buildFromVisible(work.views, labels, work.surfaces, cost_settings, context.pool,
                                         work.volume);
    }
    search();
  }
  if (options_.edge_sides)
  {
    const StageTimer timer(context, "edge sides");
    multiview::decideEdgeSides(work.views.reference, {}, context.pool, work.disparity, work.filtered);
  }
  multiview::SmoothingSettings smoothing;
  smoothing.strength = options_.refinement_smoothness;
  multiview::LinearizationSettings linearization;
  linearization.brightness_slope = options_.brightness_slope;
  work.smoother.setGuide(work.views.reference, smoothing, context.pool);
  for (int i = 0; i < options_.refinements; ++i)
  {
    {
      const StageTimer timer(context, "linearize");
      work.linearizer.run(work.views, work.disparity, linearization, context.pool, work.linearization);
    }
    const StageTimer timer(context, "smooth");
    work.smoother.run(work.linearization.weight, work.linearization.target, smoothing, context.pool,
                      work.disparity);
  }
  DisparityEstimate estimate;
  work.disparity.convertTo(estimate.disparity, CV_32F, 1.0 / unit);
  estimate.confidence = cv::Mat::ones(work.disparity.size(), CV_32FC1);
  estimate.range = *request.disparity_range;
  estimate.views_used = chosen.views.size();
  return estimate;
}

}  // namespace light_field_depth
