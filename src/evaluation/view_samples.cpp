#include "evaluation/view_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "light_field_depth/core/noise_estimate.h"

namespace light_field_depth
{
namespace
{
/// Set by hand: shares of so many pixels are good to a hundredth, and the check takes some milliseconds.
constexpr int MAX_PIXELS = 3000;
constexpr std::size_t MAX_VIEWS = 24;
/// Pixels are judged by the views that show the same surfaces.
constexpr std::size_t NEAR_VIEWS = 8;
constexpr int BORDER_PX = 4;  // of a patch and its slopes
/// A patch of 3 x 3 pixels, two pixels apart.
constexpr int PATCH_SIDE = 3;
constexpr int PATCH_PITCH_PX = 2;
constexpr std::size_t PATCH_SIZE = 9;
/// Mean difference of two patches that still agree, in terms of the contrast of the reference's and of the
/// noise: that of unrelated patches is about 1.3 times the contrast.
constexpr float MAX_MISMATCH = 0.6F;
constexpr float MISMATCH_OF_NOISE = 0.5F;
/// Patches that differ more than this, in terms of the contrast, do not tell the shift of their view.
constexpr float MAX_SHIFTED_MISMATCH = 1.2F;
/// A patch has contrast if it is so many times the noise, and so many levels.
constexpr float MIN_CONTRAST_IN_NOISE = 1.5F;
constexpr float MIN_CONTRAST_LEVELS = 2.0F;

using Patch = std::array<float, PATCH_SIZE>;

/// Brightness of a pixel of a grey or BGR image.
float brightness(const std::uint8_t* pixel, int channels)
{
  // ITU-R BT.601.
  constexpr float BLUE = 0.114F;
  constexpr float GREEN = 0.587F;
  constexpr float RED = 0.299F;
  return channels == 1 ? static_cast<float>(pixel[0])
                       : BLUE * static_cast<float>(pixel[0]) + GREEN * static_cast<float>(pixel[1]) +
                             RED * static_cast<float>(pixel[2]);
}

/// The patch about a place between pixels. @return false outside of the image
bool readPatch(const cv::Mat& image, float x, float y, Patch& patch)
{
  const int left = cvFloor(x) - PATCH_PITCH_PX;
  const int top = cvFloor(y) - PATCH_PITCH_PX;
  const int last = (PATCH_SIDE - 1) * PATCH_PITCH_PX + 1;
  if (left < 0 || top < 0 || left + last >= image.cols || top + last >= image.rows)
  {
    return false;
  }
  const float fx = x - std::floor(x);
  const float fy = y - std::floor(y);
  const int channels = image.channels();
  std::size_t i = 0;
  for (int row = 0; row < PATCH_SIDE; ++row)
  {
    const auto* const upper = image.ptr<std::uint8_t>(top + row * PATCH_PITCH_PX) + left * channels;
    const auto* const lower = image.ptr<std::uint8_t>(top + row * PATCH_PITCH_PX + 1) + left * channels;
    for (int column = 0; column < PATCH_SIDE; ++column)
    {
      const int at = column * PATCH_PITCH_PX * channels;
      patch[i++] = (1 - fy) * ((1 - fx) * brightness(upper + at, channels) +
                               fx * brightness(upper + at + channels, channels)) +
                   fy * ((1 - fx) * brightness(lower + at, channels) +
                         fx * brightness(lower + at + channels, channels));
    }
  }
  return true;
}

/// Takes the mean away.
void centre(Patch& patch)
{
  float mean = 0.0F;
  for (const float value : patch)
  {
    mean += value / static_cast<float>(PATCH_SIZE);
  }
  for (float& value : patch)
  {
    value -= mean;
  }
}

float contrastOf(const Patch& patch)
{
  float sum = 0.0F;
  for (const float value : patch)
  {
    sum += std::abs(value);
  }
  return sum / static_cast<float>(PATCH_SIZE);
}

float differenceOf(const Patch& a, const Patch& b)
{
  float sum = 0.0F;
  for (std::size_t i = 0; i < PATCH_SIZE; ++i)
  {
    sum += std::abs(a[i] - b[i]);
  }
  return sum / static_cast<float>(PATCH_SIZE);
}

/// A pixel of the reference with contrast.
struct TexturedPixel
{
  cv::Point2f place;
  float disparity = 0.0F;
  float contrast = 0.0F;
  Patch patch{};
  Patch gradient_x{};
  Patch gradient_y{};
};

float tolerance(const TexturedPixel& pixel, float noise)
{
  return MAX_MISMATCH * pixel.contrast + MISMATCH_OF_NOISE * noise;
}

/// The least squares for the shift of a view.
struct ShiftEquations
{
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double xr = 0.0;
  double yr = 0.0;

  void add(const TexturedPixel& pixel, const Patch& seen)
  {
    for (std::size_t i = 0; i < PATCH_SIZE; ++i)
    {
      const double residual = seen[i] - pixel.patch[i];
      xx += pixel.gradient_x[i] * pixel.gradient_x[i];
      xy += pixel.gradient_x[i] * pixel.gradient_y[i];
      yy += pixel.gradient_y[i] * pixel.gradient_y[i];
      xr += pixel.gradient_x[i] * residual;
      yr += pixel.gradient_y[i] * residual;
    }
  }

  /// What the view shows stands by so much to the right of and below where it should.
  cv::Point2d solve() const
  {
    const double determinant = xx * yy - xy * xy;
    if (determinant <= 1e-3 * xx * yy || determinant <= 0.0)
    {
      return {};
    }
    return {-(yy * xr - xy * yr) / determinant, -(xx * yr - xy * xr) / determinant};
  }
};

std::vector<TexturedPixel> texturedPixels(const cv::Mat& reference, const cv::Mat& disparity, float noise,
                                          int& looked_at)
{
  const int pitch = std::max(
      1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(reference.total()) / MAX_PIXELS))));
  const float least = std::max(MIN_CONTRAST_IN_NOISE * noise, MIN_CONTRAST_LEVELS);
  std::vector<TexturedPixel> pixels;
  looked_at = 0;
  for (int y = BORDER_PX; y < reference.rows - BORDER_PX; y += pitch)
  {
    for (int x = BORDER_PX; x < reference.cols - BORDER_PX; x += pitch)
    {
      TexturedPixel pixel;
      pixel.place = cv::Point2f(static_cast<float>(x), static_cast<float>(y));
      pixel.disparity = disparity.at<float>(y, x);
      ++looked_at;
      if (!std::isfinite(pixel.disparity) || !readPatch(reference, pixel.place.x, pixel.place.y, pixel.patch))
      {
        continue;
      }
      centre(pixel.patch);
      pixel.contrast = contrastOf(pixel.patch);
      Patch before{};
      Patch behind{};
      if (pixel.contrast < least || !readPatch(reference, pixel.place.x - 1, pixel.place.y, before) ||
          !readPatch(reference, pixel.place.x + 1, pixel.place.y, behind))
      {
        continue;
      }
      for (std::size_t i = 0; i < PATCH_SIZE; ++i)
      {
        pixel.gradient_x[i] = 0.5F * (behind[i] - before[i]);
      }
      if (!readPatch(reference, pixel.place.x, pixel.place.y - 1, before) ||
          !readPatch(reference, pixel.place.x, pixel.place.y + 1, behind))
      {
        continue;
      }
      for (std::size_t i = 0; i < PATCH_SIZE; ++i)
      {
        pixel.gradient_y[i] = 0.5F * (behind[i] - before[i]);
      }
      pixels.push_back(pixel);
    }
  }
  return pixels;
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

/// @param mismatches one for each pixel: difference in levels, or OUTSIDE
ViewAgreement compare(const View& view, const std::vector<TexturedPixel>& pixels, float noise,
                      std::vector<float>& mismatches)
{
  ViewAgreement agreement;
  ShiftEquations equations;
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    const TexturedPixel& pixel = pixels[i];
    const cv::Point2f place =
        pixel.place - pixel.disparity * cv::Point2f(view.steps) + cv::Point2f(view.offset_px);
    Patch seen{};
    mismatches[i] = OUTSIDE;
    if (!readPatch(view.image, place.x, place.y, seen))
    {
      continue;
    }
    centre(seen);
    ++agreement.seen;
    mismatches[i] = differenceOf(seen, pixel.patch);
    if (mismatches[i] <= tolerance(pixel, noise))
    {
      ++agreement.agreeing;
    }
    if (mismatches[i] <= MAX_SHIFTED_MISMATCH * pixel.contrast)
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
