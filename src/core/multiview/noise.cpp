#include "light_field_depth/core/multiview/noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace light_field_depth::multiview
{
namespace
{
constexpr int BLOCK_PX = 8;
/// The mask (1 -2 1) x (1 -2 1) multiplies the standard deviation of white noise by this.
constexpr double MASK_GAIN = 6.0;
/// The block at this quantile is smooth; of pure noise it shows a little less than the standard deviation.
constexpr double QUANTILE = 0.1;
constexpr double QUANTILE_BIAS = 0.81;
/// Blocks whose mean lies outside may be clipped.
constexpr double DARKEST = 8.0;
constexpr double BRIGHTEST = 247.0;

/// Below this the views count as clean, in 8-bit units.
constexpr float CLEAN_SIGMA = 1.2F;
constexpr float BLUR_BASE_PX = 0.55F;
constexpr float BLUR_PER_SIGMA_PX = 0.056F;
constexpr float MAX_BLUR_PX = 1.2F;
constexpr float TRUNCATION_PER_SIGMA = 10.0F;
constexpr float PENALTY_PER_SIGMA = 10.0F;
constexpr float CONTRAST_PER_SIGMA = 6.0F;
constexpr int MAX_TRUNCATION = 60;
constexpr float WIDE_WINDOW_SIGMA = 2.5F;
constexpr int WIDE_WINDOW_RADIUS = 4;

}  // namespace

float measureNoise(const cv::Mat& image)
{
  const cv::Matx33f mask(1, -2, 1, -2, 4, -2, 1, -2, 1);
  std::vector<double> deviations;
  for (int channel = 0; channel < image.channels(); ++channel)
  {
    cv::Mat plane;
    cv::Mat response;
    cv::extractChannel(image, plane, channel);
    cv::filter2D(plane, response, CV_32F, mask);
    for (int y = 0; y + BLOCK_PX <= image.rows; y += BLOCK_PX)
    {
      for (int x = 0; x + BLOCK_PX <= image.cols; x += BLOCK_PX)
      {
        const cv::Rect block(x, y, BLOCK_PX, BLOCK_PX);
        const double mean = cv::mean(plane(block))[0];
        if (mean > DARKEST && mean < BRIGHTEST)
        {
          deviations.push_back(cv::norm(response(block)) / (BLOCK_PX * MASK_GAIN));
        }
      }
    }
  }
  if (deviations.empty())
  {
    return 0.0F;
  }
  const auto smooth =
      deviations.begin() + static_cast<std::ptrdiff_t>(QUANTILE * static_cast<double>(deviations.size()));
  std::nth_element(deviations.begin(), smooth, deviations.end());
  return static_cast<float>(*smooth / QUANTILE_BIAS);
}

void adaptToNoise(float noise_sigma, SolverSettings& settings)
{
  settings.noise_sigma = noise_sigma;
  if (noise_sigma < CLEAN_SIGMA)
  {
    return;
  }
  const float blur = std::min(BLUR_BASE_PX + BLUR_PER_SIGMA_PX * noise_sigma, MAX_BLUR_PX);
  settings.blur_sigma_px = blur;
  const float left = noise_sigma / (2.0F * std::sqrt(static_cast<float>(CV_PI)) * blur);
  settings.cost.truncation =
      std::clamp(cvRound(TRUNCATION_PER_SIGMA * left), settings.cost.truncation, MAX_TRUNCATION);
  settings.cost.unseen_penalty = std::max(settings.cost.unseen_penalty, settings.cost.truncation);
  settings.paths.small_step += cvRound(PENALTY_PER_SIGMA * left);
  settings.edge_sides.min_contrast += CONTRAST_PER_SIGMA * left;
  if (noise_sigma >= WIDE_WINDOW_SIGMA)
  {
    settings.linearization.window_radius = WIDE_WINDOW_RADIUS;
  }
}

}  // namespace light_field_depth::multiview
