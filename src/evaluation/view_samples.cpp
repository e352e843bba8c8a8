#include "evaluation/view_samples.h"

#include <algorithm>
#include <cmath>

#include "evaluation/textured_pixels.h"
#include "light_field_depth/core/noise_estimate.h"

namespace light_field_depth
{
namespace
{
/// Set by hand: the check takes some milliseconds.
constexpr std::size_t MAX_VIEWS = 24;
/// Pixels are judged by the views that show the same surfaces.
constexpr std::size_t NEAR_VIEWS = 8;
/// Mean difference of two patches that still agree, in terms of the contrast of the reference's and of the
/// noise: that of unrelated patches is about 1.3 times the contrast.
constexpr float MAX_MISMATCH = 0.6F;
constexpr float MISMATCH_OF_NOISE = 0.5F;
float tolerance(const TexturedPixel& pixel, float noise)
{
  return MAX_MISMATCH * pixel.contrast + MISMATCH_OF_NOISE * noise;
}

/// At most MAX_VIEWS of the views without the reference: the nearest ones, then others, evenly.
std::vector<std::size_t> chosenViews(const LightField& light_field)
{
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    if (i != light_field.reference_index)
    {
      others.push_back(i);
    }
  }
  const auto distance = [&](std::size_t i)
  { return std::hypot(light_field.views[i].steps.x, light_field.views[i].steps.y); };
  std::stable_sort(others.begin(), others.end(),
                   [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  if (others.size() <= MAX_VIEWS)
  {
    return others;
  }
  std::vector<std::size_t> chosen(others.begin(), others.begin() + NEAR_VIEWS);
  const std::size_t rest = others.size() - NEAR_VIEWS;
  for (std::size_t i = 0; i < MAX_VIEWS - NEAR_VIEWS; ++i)
  {
    chosen.push_back(others[NEAR_VIEWS + i * rest / (MAX_VIEWS - NEAR_VIEWS)]);
  }
  return chosen;
}

/// No difference of two patches.
constexpr float OUTSIDE = -1.0F;

float median(std::vector<float>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What makes the contrast of a view that of the reference: with half the exposure it is 2.
float gainOf(const View& view, const std::vector<TexturedPixel>& pixels)
{
  constexpr float MAX_GAIN = 4.0F;  // two stops; beyond them noise or white is all that is left
  std::vector<float> of_reference;
  std::vector<float> of_view;
  for (const TexturedPixel& pixel : pixels)
  {
    Patch seen{};
    if (readSeenPatch(view, pixel, view.steps, {}, seen))
    {
      of_reference.push_back(pixel.contrast);
      of_view.push_back(contrastOf(seen));
    }
  }
  const float contrast = of_view.empty() ? 0.0F : median(of_view);
  return contrast > 0.0F ? std::clamp(median(of_reference) / contrast, 1.0F / MAX_GAIN, MAX_GAIN) : 1.0F;
}

/// @param mismatches one for each pixel: difference in levels, or OUTSIDE
ViewAgreement compare(const View& view, const std::vector<TexturedPixel>& pixels, float noise,
                      std::vector<float>& mismatches)
{
  ViewAgreement agreement;
  ShiftEquations equations;
  const float gain = gainOf(view, pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    const TexturedPixel& pixel = pixels[i];
    Patch seen{};
    mismatches[i] = OUTSIDE;
    if (!readSeenPatch(view, pixel, view.steps, {}, seen))
    {
      continue;
    }
    std::transform(seen.begin(), seen.end(), seen.begin(), [gain](float value) { return gain * value; });
    ++agreement.seen;
    mismatches[i] = differenceOf(seen, pixel.patch);
    if (mismatches[i] <= tolerance(pixel, noise))
    {
      ++agreement.agreeing;
    }
    if (tellsShift(pixel, mismatches[i]))
    {
      equations.add(pixel, seen);
    }
  }
  agreement.shift_px = equations.solve();
  return agreement;
}

}  // namespace

ViewSamples sampleViews(const LightField& light_field, const cv::Mat& disparity, ThreadPool& pool)
{
  ViewSamples samples;
  const cv::Mat& reference = light_field.reference().image;
  const float noise = estimateNoise(reference);
  samples.noise_levels = noise;
  const std::vector<TexturedPixel> pixels = texturedPixels(reference, disparity, noise, samples.pixels);
  samples.textured = static_cast<int>(pixels.size());
  const std::vector<std::size_t> chosen = chosenViews(light_field);
  samples.views.resize(chosen.size());
  std::vector<std::vector<float>> mismatches(chosen.size(), std::vector<float>(pixels.size()));
  pool.parallelFor(0, static_cast<int>(chosen.size()), 1,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       samples.views[i] = compare(light_field.views[chosen[i]], pixels, noise, mismatches[i]);
                       samples.views[i].view_index = chosen[i];
                     }
                   });
  std::vector<float> of_pixel;
  for (std::size_t p = 0; p < pixels.size(); ++p)
  {
    samples.disparities.push_back(pixels[p].disparity);
    of_pixel.clear();
    for (std::size_t i = 0; i < std::min(mismatches.size(), NEAR_VIEWS); ++i)
    {
      if (mismatches[i][p] != OUTSIDE)
      {
        of_pixel.push_back(mismatches[i][p]);
      }
    }
    if (of_pixel.empty())
    {
      continue;
    }
    const auto middle = of_pixel.begin() + static_cast<std::ptrdiff_t>(of_pixel.size() / 2);
    std::nth_element(of_pixel.begin(), middle, of_pixel.end());
    samples.agreeing += *middle <= tolerance(pixels[p], noise) ? 1 : 0;
    samples.difference_levels += *middle / static_cast<double>(pixels.size());
  }
  return samples;
}

}  // namespace light_field_depth
