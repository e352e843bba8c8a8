#include "core/multiview/scene_measurement.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "core/light_field/reach.h"
#include "core/preprocess/even_exposure.h"
#include "core/preprocess/view_noise.h"
#include "light_field_depth/core/disparity_range.h"
#include "light_field_depth/core/exposure.h"
#include "light_field_depth/core/noise_estimate.h"
#include "light_field_depth/core/registration.h"

namespace light_field_depth::multiview
{
namespace
{
/// Of half the resolution: smaller views are not halved again to measure the scene.
constexpr int MIN_QUARTERED_SIDE_PX = 96;
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

/// Of a point at infinity, where no shear and no guess hides it.
std::optional<float> farthestDisparity(const LightField& light_field)
{
  if (light_field.calibration && light_field.calibration->disparity_offset_px == 0.0)
  {
    return 0.0F;
  }
  return std::nullopt;
}

}  // namespace

float measureNoise(const LightField& light_field, const DisparityRange& range, ThreadPool& pool)
{
  constexpr float least_sigma = 0.85F;  // below it views count as clean
  constexpr float least_ratio = 1.5F;   // the two measures agree to a fifth on white noise
  constexpr float correlated = 1.3F;
  const float of_image = estimateNoise(light_field.reference().image);
  const float of_views = estimateNoiseOfViews(light_field, range, pool);
  const bool is_correlated = of_views > least_sigma && of_views > least_ratio * of_image;
  return is_correlated ? std::max(of_image, correlated * of_views) : of_image;
}

LightField SceneMeasurement::measure(const LightField& views, const EstimateRequest& request,
                                     const MultiviewOptions& options, RunContext& context,
                                     SceneMeasures& measures)
{
  const cv::Size size = views.size();
  const bool quickly = options.preset == MultiviewPreset::Fast &&
                       std::min(size.width, size.height) >= MIN_QUARTERED_SIDE_PX &&
                       views.views.size() > MAX_VIEWS_MEASURED_AT_HALF_RESOLUTION;
  return quickly ? measureQuickly(views, request, context, measures)
                 : measureFully(views, request, options, context, measures);
}

LightField SceneMeasurement::measureFully(const LightField& views, const EstimateRequest& request,
                                          const MultiviewOptions& options, RunContext& context,
                                          SceneMeasures& measures)
{
  const bool halved = isMeasuredHalved(views.size());
  DisparityRangeOptions range_options;
  range_options.max_displacement_px *= halved ? 0.5F : 1.0F;
  range_options.farthest_px = farthestDisparity(views);
  LightField chosen;
  LightField small;
  {
    const StageTimer timer(context, "exposure");
    small = halved ? half_.reduceInColour(views, context.pool) : views;
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
  if (options.registration)
  {
    const StageTimer timer(context, "registration");
    RegistrationOptions registration_options;
    registration_options.pixel_size = halved ? 2.0 : 1.0;
    measures.registration = estimateRegistration(small, measures.range, context.pool, registration_options);
    chosen = correctRegistration(chosen, measures.registration, context.pool);
  }
  const StageTimer timer(context, "noise");
  measures.noise_sigma = measureNoise(chosen, measures.range, context.pool);
  return chosen;
}

/// From views of a quarter of the resolution, and without a search for small differences in exposure, where
/// there are many views.
LightField SceneMeasurement::measureQuickly(const LightField& views, const EstimateRequest& request,
                                            RunContext& context, SceneMeasures& measures)
{
  LightField chosen = views;
  LightField quarter;
  measures.exposures.resize(views.views.size());
  {
    const StageTimer timer(context, "exposure");
    quarter = quarter_.reduce(views, context.pool);
    if (!looksEvenlyExposed(quarter))
    {
      measures.exposures = estimateExposure(views, context.pool);
      chosen = compensateExposure(views, measures.exposures, context.pool);
      quarter = quarter_.reduce(chosen, context.pool);
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
  measures.noise_sigma = measureNoise(chosen, measures.range, context.pool);
  return chosen;
}

}  // namespace light_field_depth::multiview
