#include "light_field_depth/core/pipeline.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "core/light_field/reach.h"
#include "core/light_field/view_mask.h"
#include "core/multiview/multiview_estimator.h"
#include "core/paper2017/paper2017_estimator.h"
#include "light_field_depth/core/enum_names.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/core/geometry.h"

namespace light_field_depth
{
namespace
{
constexpr float BELOW_EVERY_CONFIDENCE = -1.0F;  // they are 0 to 1

constexpr EnumNames<Method, 2> METHOD_NAMES = {{
    {Method::Multiview, "multiview"},
    {Method::Paper2017, "paper2017"},
}};

void append(std::vector<std::string>& problems, std::vector<std::string> more)
{
  std::move(more.begin(), more.end(), std::back_inserter(problems));
}

void throwIfAny(const std::vector<std::string>& problems)
{
  if (problems.empty())
  {
    return;
  }
  std::string text;
  for (const std::string& problem : problems)
  {
    text += (text.empty() ? "" : " ") + problem;
  }
  throw InputError(text);
}

/// The caller's allocator, or that of a vector.
PointAllocator allocatorOr(const PointAllocator& allocator, std::vector<ColoredPoint>& points)
{
  if (allocator)
  {
    return allocator;
  }
  return [&points](std::size_t count)
  {
    points.resize(count);
    return points.data();
  };
}

/// Refinement lets the slopes of surfaces go on a little beyond the ends of the range; a range that was given
/// is a promise, so that the maps end there.
void keepInRange(const DisparityRange& range, cv::Mat& map)
{
  for (int y = 0; y < map.rows; ++y)
  {
    auto* const row = map.ptr<float>(y);
    std::transform(row, row + map.cols, row,
                   [&range](float value) { return std::clamp(value, range.min, range.max); });
  }
}

void keepInRange(const std::optional<DisparityRange>& range, std::vector<ViewDisparity>& maps)
{
  for (ViewDisparity& view : maps)
  {
    if (range)
    {
      keepInRange(*range, view.disparity);
    }
  }
}

cv::Mat limited(const cv::Mat& disparity, const LightField& light_field, const PipelineOptions& options)
{
  return limitDepth(disparity, *light_field.calibration, options.min_depth_m, options.max_depth_m);
}

/// The dense cloud of maps that are finished but for the limits of depth.
void fuse(const LightField& light_field, const PipelineOptions& options, std::vector<ViewDisparity> maps,
          RunContext& context, const DensePointSink& sink)
{
  const StageTimer timer(context, "dense_cloud");
  for (ViewDisparity& map : maps)
  {
    map.disparity = limited(map.disparity, light_field, options);
  }
  denseCloud(light_field, maps, options.dense_cloud, context.pool, sink);
}

/// How many maps the run itself solves.
std::size_t mapsOf(const PipelineOptions& options, const ProductRequest& request, bool calibrated)
{
  const auto all = static_cast<std::size_t>(options.dense_cloud.maps);
  if (request.view_maps || (request.dense_cloud && calibrated))
  {
    return all;
  }
  if (request.dense_cloud_later && calibrated)
  {
    // Those of the method of 2017 come out of the volumes of the run.
    return options.method == Method::Multiview ? 1 : all;
  }
  return 0;
}

}  // namespace

std::string toString(Method method)
{
  return enumName(METHOD_NAMES, method);
}

Method methodFromString(const std::string& name)
{
  return enumValue(METHOD_NAMES, name, "method");
}

std::vector<std::string> methodNames()
{
  std::vector<std::string> names;
  names.reserve(METHOD_NAMES.size());
  for (const auto& entry : METHOD_NAMES)
  {
    names.emplace_back(entry.second);
  }
  return names;
}

std::vector<std::string> validate(const PipelineOptions& options)
{
  std::vector<std::string> problems;
  if (options.disparity_range)
  {
    const DisparityRange& range = *options.disparity_range;
    if (!std::isfinite(range.min) || !std::isfinite(range.max) || range.min >= range.max)
    {
      problems.push_back("disparity_range is " + std::to_string(range.min) + ".." +
                         std::to_string(range.max) + " px; give two finite numbers, the smaller first.");
    }
  }
  if (!(options.min_confidence >= 0.0F && options.min_confidence <= 1.0F))
  {
    problems.push_back("min_confidence is " + std::to_string(options.min_confidence) +
                       "; it must be between 0 and 1.");
  }
  if (!(options.min_depth_m >= 0.0F && options.max_depth_m >= 0.0F) ||
      (options.max_depth_m > 0.0F && options.max_depth_m <= options.min_depth_m))
  {
    problems.push_back("min_depth_m is " + std::to_string(options.min_depth_m) + " and max_depth_m is " +
                       std::to_string(options.max_depth_m) +
                       "; give the smaller first, in metres, or 0 for no limit.");
  }
  append(problems, validate(options.dense_cloud));
  append(problems, validate(options.paper2017));
  append(problems, validate(options.multiview));
  return problems;
}

ViewSelection viewsToRead(const LightField& light_field, const PipelineOptions& options)
{
  // The volumes of the method of 2017 may lie anywhere.
  return options.method == Method::Multiview ? selectionOf(light_field, options.views) : ViewSelection::All;
}

Pipeline::Pipeline(int threads) : pool_(threads)
{
  pool_.setCancellation(&cancellation_);
}

Pipeline::~Pipeline() = default;

void Pipeline::forget()
{
  multiview_.reset();
  paper2017_.reset();
}

MultiviewEstimator& Pipeline::multiviewEstimator(const PipelineOptions& options)
{
  if (!multiview_)
  {
    multiview_ = std::make_unique<MultiviewEstimator>();
  }
  multiview_->setOptions(options.multiview);
  return *multiview_;
}

Estimator& Pipeline::estimatorFor(const PipelineOptions& options)
{
  if (options.method == Method::Multiview)
  {
    return multiviewEstimator(options);
  }
  if (!paper2017_)
  {
    paper2017_ = std::make_unique<Paper2017Estimator>();
  }
  paper2017_->setOptions(options.paper2017);
  return *paper2017_;
}

void Pipeline::unproject(const LightField& light_field, const PipelineOptions& options,
                         const ProductRequest& request, RunContext& context, PipelineResult& result)
{
  const DisparityEstimate& estimate = result.estimate;
  cv::Mat trust = estimate.confidence;
  if (!options.keep_filled && !estimate.filled.empty())
  {
    trust = trust.clone();
    trust.setTo(BELOW_EVERY_CONFIDENCE, estimate.filled);
  }
  const cv::Mat disparity = limited(estimate.disparity, light_field, options);
  if (request.depth)
  {
    const StageTimer timer(context, "depth");
    result.depth = depthMap(disparity, *light_field.calibration);
    result.depth.setTo(std::nan(""), trust < options.min_confidence);
  }
  if (request.organized_cloud)
  {
    const StageTimer timer(context, "cloud");
    const std::size_t count = estimate.disparity.total();
    ColoredPoint* const points =
        allocatorOr(request.organized_cloud_allocator, result.organized_cloud)(count);
    if (points != nullptr)
    {
      unprojectReference(light_field, disparity, trust, options.min_confidence, pool_, points);
    }
  }
  if (request.dense_cloud)
  {
    const DensePointSink into_result = [&result](const DensePoint* points, std::size_t count)
    { result.dense_cloud.insert(result.dense_cloud.end(), points, points + count); };
    fuse(light_field, options, estimate.view_disparities, context,
         request.dense_cloud_sink ? request.dense_cloud_sink : into_result);
  }
}

PipelineResult Pipeline::run(const LightField& light_field, const PipelineOptions& options,
                             const ProductRequest& request)
{
  throwIfAny(validate(options));
  if (options.disparity_range)
  {
    checkReach(*options.disparity_range, light_field);
  }
  const auto start = std::chrono::steady_clock::now();
  RunContext context(pool_);
  context.save_intermediate = intermediate_sink_;
  context.progress = progress_sink_;

  const bool calibrated = light_field.calibration.has_value();
  EstimateRequest estimate_request;
  estimate_request.disparity_range = options.disparity_range;
  estimate_request.views = options.views;
  estimate_request.solved_maps = mapsOf(options, request, calibrated);

  // The clouds and the estimate see the same bytes: those of 16 bits are converted once.
  const bool colours =
      calibrated && (request.organized_cloud || request.dense_cloud || request.dense_cloud_later);
  const LightField known = withFilledMasks(light_field, pool_);
  const LightField shown = colours ? toEightBit(known) : known;
  PipelineResult result;
  result.estimate = estimatorFor(options).estimate(shown, estimate_request, context);
  if (options.disparity_range)
  {
    keepInRange(*options.disparity_range, result.estimate.disparity);
  }
  keepInRange(options.disparity_range, result.estimate.view_disparities);
  invalidateMasked(shown, result.estimate);
  if (request.view_maps)
  {
    const StageTimer timer(context, "maps_of_views");
    viewMaps(shown, result.estimate.view_disparities, options.dense_cloud, pool_, request.view_maps);
  }
  if (calibrated)
  {
    unproject(shown, options, request, context, result);
  }
  result.stage_times = std::move(context.stage_times);
  result.total_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::vector<StageTime> Pipeline::runDenseCloud(const LightField& light_field, const PipelineOptions& options,
                                               const DisparityEstimate& estimate, const DensePointSink& sink)
{
  throwIfAny(validate(options));
  RunContext context(pool_);
  if (!light_field.calibration)
  {
    return {};
  }
  const LightField shown = toEightBit(withFilledMasks(light_field, pool_));
  std::vector<ViewDisparity> maps = estimate.view_disparities;
  if (options.method == Method::Multiview)
  {
    EstimateRequest request;
    request.views = options.views;
    request.solved_maps = static_cast<std::size_t>(options.dense_cloud.maps);
    std::vector<ViewDisparity> others =
        multiviewEstimator(options).solveOtherViews(shown, request, estimate, context);
    // The reference's map is finished, and others may be reading it.
    keepInRange(options.disparity_range, others);
    invalidateMasked(shown, others);
    std::move(others.begin(), others.end(), std::back_inserter(maps));
  }
  fuse(shown, options, std::move(maps), context, sink);
  return std::move(context.stage_times);
}

}  // namespace light_field_depth
