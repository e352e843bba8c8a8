#include "io/linear_images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

namespace light_field_depth
{
namespace
{
constexpr double BELOW_WHITE = 0.999;  // of the pixels, as in toEightBit(): the rest are glints
constexpr float MAX_LEVEL = 65535.0F;  // of 16 bits

float sRgbCurve(float linear)
{
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

}  // namespace

float whiteOf(const cv::Mat& image)
{
  std::vector<float> values;
  const int width = image.cols * image.channels();
  for (int y = 0; y < image.rows; ++y)
  {
    const auto* const row = image.ptr<float>(y);
    std::copy_if(row, row + width, std::back_inserter(values),
                 [](float value) { return std::isfinite(value); });
  }
  if (values.empty())
  {
    return 1.0F;
  }
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(BELOW_WHITE * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return std::max(1.0F, *place);
}

cv::Mat encodedLinear(const cv::Mat& image, float white)
{
  cv::Mat levels(image.size(), CV_16UC(image.channels()));
  const int width = image.cols * image.channels();
  for (int y = 0; y < image.rows; ++y)
  {
    const auto* const from = image.ptr<float>(y);
    auto* const to = levels.ptr<std::uint16_t>(y);
    for (int x = 0; x < width; ++x)
    {
      // The comparison is false for what is not a number.
      const float light = from[x] > 0.0F ? std::min(from[x] / white, 1.0F) : 0.0F;
      to[x] = static_cast<std::uint16_t>(std::lround(MAX_LEVEL * sRgbCurve(light)));
    }
  }
  return levels;
}

}  // namespace light_field_depth
