#include "core/multiview/solver_settings.h"

#include <algorithm>
#include <cmath>

#include "core/multiview/noise.h"
#include "core/multiview/pair.h"

namespace light_field_depth::multiview
{
namespace
{
/// The settings are meant for this distance of the outermost view, in grid steps.
constexpr double REFERENCE_BASELINE = 4.0;

}  // namespace

double solverUnit(const LightField& light_field)
{
  double widest = 0.0;
  for (const View& view : light_field.views)
  {
    widest = std::max({widest, std::abs(view.steps.x), std::abs(view.steps.y)});
  }
  return widest / REFERENCE_BASELINE;
}

LightField inSolverUnit(LightField light_field, double unit)
{
  for (View& view : light_field.views)
  {
    view.steps *= 1.0 / unit;
  }
  return light_field;
}

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
  settings.search.paths.small_change_penalty = options.small_change_penalty;
  settings.search.paths.large_change_penalty = options.large_change_penalty;
  settings.search.visibility_passes = options.visibility_passes;
  settings.search.fuse_background = options.background_fusion && !settings.grey_search;
  settings.search.keep_thin_structures = options.thin_structures;
  settings.decide_boundary_pixels = options.boundary_pixels;
  settings.refinement.refinements = options.refinements;
  settings.refinement.linearization.brightness_slope = options.brightness_slope;
  settings.refinement.smoothing.strength = options.refinement_smoothness;
  settings.search.detect_changes = options.temporal;
  adaptToNoise(measures.noise_sigma, settings);
  if (isPair(light_field))
  {
    adaptToPair(given, settings);
  }
  return settings;
}

}  // namespace light_field_depth::multiview
