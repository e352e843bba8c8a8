#include "evaluation/textured_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace light_field_depth
{
namespace
{
/// Set by hand: shares of so many pixels are good to a hundredth, and the check takes some milliseconds.
constexpr int MAX_PIXELS = 3000;
constexpr int BORDER_PX = 4;  // of a patch and its slopes
constexpr int PATCH_SIDE = 3;
constexpr int PATCH_PITCH_PX = 2;
constexpr std::size_t PATCH_SIZE = PATCH_SIDE * PATCH_SIDE;
/// Patches that differ more than this, in terms of the contrast, do not tell the shift of their view.
constexpr float MAX_SHIFTED_MISMATCH = 1.2F;
/// A patch has contrast if it is so many times the noise, and so many levels.
constexpr float MIN_CONTRAST_IN_NOISE = 1.5F;
constexpr float MIN_CONTRAST_LEVELS = 2.0F;

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

}  // namespace

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

bool readSeenPatch(const View& view, const TexturedPixel& pixel, const cv::Point2d& steps,
                   const cv::Point2d& shift_px, Patch& patch)
{
  const cv::Point2f place =
      pixel.place - pixel.disparity * cv::Point2f(steps) + cv::Point2f(view.offset_px + shift_px);
  if (!readPatch(view.image, place.x, place.y, patch))
  {
    return false;
  }
  centre(patch);
  return true;
}

bool tellsShift(const TexturedPixel& pixel, float difference)
{
  return difference <= MAX_SHIFTED_MISMATCH * pixel.contrast;
}

void ShiftEquations::add(const TexturedPixel& pixel, const Patch& seen)
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

cv::Point2d ShiftEquations::solve() const
{
  const double determinant = xx * yy - xy * xy;
  if (determinant <= 1e-3 * xx * yy || determinant <= 0.0)
  {
    return {};
  }
  return {-(yy * xr - xy * yr) / determinant, -(xx * yr - xy * xr) / determinant};
}

}  // namespace light_field_depth
