#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SCENE_MEASUREMENT_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SCENE_MEASUREMENT_H

#include "core/light_field/half_resolution.h"
#include "core/multiview/sequence.h"
#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/multiview_options.h"
#include "light_field_depth/core/run_context.h"

namespace light_field_depth::multiview
{
/// Standard deviation of the noise in 8-bit levels.
///
/// What one image tells, unless differences of views tell much more: noise that demosaicing, denoising or
/// compression has correlated from pixel to pixel looks like texture in one image. The search and the
/// windows average less of it than of white noise of the same strength, so it counts for more.
/// @param range in the unit of the light field
float measureNoise(const LightField& light_field, const DisparityRange& range, ThreadPool& pool);

/// Measures exposure, range, registration and noise before a full search. Keeps its memory; one call at a
/// time.
class SceneMeasurement
{
public:
  /// @param views of half the resolution with the preset `fast`
  /// @return the views, made equal in exposure and put into their places
  LightField measure(const LightField& views, const EstimateRequest& request, const MultiviewOptions& options,
                     RunContext& context, SceneMeasures& measures);

private:
  LightField measureFully(const LightField& views, const EstimateRequest& request,
                          const MultiviewOptions& options, RunContext& context, SceneMeasures& measures);
  LightField measureQuickly(const LightField& views, const EstimateRequest& request, RunContext& context,
                            SceneMeasures& measures);

  HalfResolution half_;
  HalfResolution quarter_;  ///< half of what the preset `fast` is given
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SCENE_MEASUREMENT_H
