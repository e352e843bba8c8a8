#include "core/multiview/noise.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace light_field_depth::multiview
{
namespace
{
// Set by hand; docs/experiments.md has what half and twice as much of each does under noise of 2 and 5
// levels.

/// Below this the views count as clean, in 8-bit units.
constexpr float CLEAN_SIGMA = 1.2F;
/// Of a Gaussian. Fine structures want less, surfaces more.
constexpr float BLUR_BASE_PX = 0.55F;
constexpr float BLUR_PER_SIGMA_PX = 0.056F;
constexpr float MAX_BLUR_PX = 1.2F;
/// For each level of noise that the blur leaves. The truncation exceeds what it is without noise from 13
/// levels on only; the contrast hardly matters between 3 and 12.
constexpr float TRUNCATION_PER_SIGMA = 10.0F;
constexpr float PENALTY_PER_SIGMA = 10.0F;
constexpr float CONTRAST_PER_SIGMA = 6.0F;
/// Of boundary pixels, docs/experiments.md: what is gained at 1.1 levels and more, as cameras and their
/// demosaicing leave them, is lost on clean renders, which have up to 0.5.
constexpr float NOISY_RELATIVE_SPREAD = 0.8F;  // 0.6 and 1.2 are as good within 3 %
constexpr float SPREADING_SIGMA = 0.7F;
constexpr float SPREAD_SIGMA = 1.1F;
constexpr int MAX_TRUNCATION = 60;             // reached by noise of 25 levels
constexpr float NOISY_LABEL_STEP_PX = 0.125F;  // finer ones are below what noise lets see
/// From here on the frame takes longer (docs/experiments.md has what that is worth).
constexpr float STRONG_SIGMA = 2.5F;
constexpr int STRONG_NOISE_PASSES = 3;
constexpr int WIDE_WINDOW_RADIUS = 4;  // 3 and 5 are as good within 2 %

}  // namespace

void adaptToNoise(float noise_sigma, SolverSettings& settings)
{
  settings.noise_sigma = noise_sigma;
  float& spread = settings.boundary_pixels.max_relative_spread;
  spread += (NOISY_RELATIVE_SPREAD - spread) *
            std::clamp((noise_sigma - SPREADING_SIGMA) / (SPREAD_SIGMA - SPREADING_SIGMA), 0.0F, 1.0F);
  if (noise_sigma < CLEAN_SIGMA)
  {
    return;
  }
  const float blur = std::min(BLUR_BASE_PX + BLUR_PER_SIGMA_PX * noise_sigma, MAX_BLUR_PX);
  settings.blur_sigma_px = blur;
  const float left = noise_sigma / (2.0F * std::sqrt(static_cast<float>(CV_PI)) * blur);
  settings.search.cost.truncation =
      std::clamp(cvRound(TRUNCATION_PER_SIGMA * left), settings.search.cost.truncation, MAX_TRUNCATION);
  settings.search.cost.unseen_penalty =
      std::max(settings.search.cost.unseen_penalty, settings.search.cost.truncation);
  settings.label_step_px = std::max(settings.label_step_px, NOISY_LABEL_STEP_PX);
  settings.search.paths.small_change_penalty += cvRound(PENALTY_PER_SIGMA * left);
  settings.boundary_pixels.min_contrast += CONTRAST_PER_SIGMA * left;
  if (noise_sigma >= STRONG_SIGMA)
  {
    settings.refinement.linearization.window_radius = WIDE_WINDOW_RADIUS;
    settings.search.last_small_change_share = 1.0F;
    settings.search.last_large_change_share = 1.0F;
    // Worth their time only here, and only where colour is worth its time.
    if (!settings.grey_search)
    {
      settings.search.visibility_passes =
          settings.search.visibility_passes > 0
              ? std::max(settings.search.visibility_passes, STRONG_NOISE_PASSES)
              : 0;
      settings.refinement.refinements += settings.refinement.refinements > 0 ? 1 : 0;
    }
  }
}

}  // namespace light_field_depth::multiview
