// Images of 16 bits as images of 8 bits.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
namespace
{
/// Levels of 16 bits that become 0 and 255.
struct Window
{
  double black;
  double white;
};

constexpr std::size_t LEVELS = 1U << 16U;  // of 16 bits
/// Every so many rows are counted: a percentile needs no more.
constexpr int ROW_STEP = 4;
/// Of all values, on either side, that do not decide the window: hot and dead pixels, glints.
constexpr double IGNORED = 1e-3;
/// Values that fill less of the powers of two than this have a window of their own.
constexpr double MIN_FILL = 0.25;
/// Of the width of such a window, left free on both sides for what the percentiles cut off.
constexpr double MARGIN = 0.05;
/// Such a window begins and ends at multiples of this share of its width, so that a video's windows seldom
/// change.
constexpr double GRAIN = 1.0 / 16.0;

std::vector<std::size_t> histogram(const LightField& light_field)
{
  std::vector<std::size_t> counts(LEVELS, 0);
  for (const View& view : light_field.views)
  {
    const int values = view.image.cols * view.image.channels();
    for (int y = 0; y < view.image.rows; y += ROW_STEP)
    {
      const auto* const row = view.image.ptr<std::uint16_t>(y);
      for (int x = 0; x < values; ++x)
      {
        ++counts[row[x]];
      }
    }
  }
  return counts;
}

/// The level below which a share of all values lies.
double percentile(const std::vector<std::size_t>& counts, double share)
{
  std::size_t all = 0;
  for (const std::size_t count : counts)
  {
    all += count;
  }
  const double wanted = share * static_cast<double>(all);
  std::size_t below = 0;
  for (std::size_t level = 0; level < counts.size(); ++level)
  {
    below += counts[level];
    if (static_cast<double>(below) > wanted)
    {
      return static_cast<double>(level);
    }
  }
  return static_cast<double>(counts.size() - 1);
}

Window windowOf(const LightField& light_field)
{
  const std::vector<std::size_t> counts = histogram(light_field);
  const double low = percentile(counts, IGNORED);
  const double high = percentile(counts, 1.0 - IGNORED);
  const double full_scale = std::max(256.0, std::exp2(std::ceil(std::log2(high + 1.0))));
  if (high - low >= MIN_FILL * full_scale || full_scale == 256.0)
  {
    return {0.0, full_scale - 1.0};
  }
  const double width = std::max(255.0, (1.0 + 2.0 * MARGIN) * (high - low));
  const double grain = std::exp2(std::floor(std::log2(GRAIN * width)));
  const double black = std::max(0.0, std::floor((0.5 * (low + high) - 0.5 * width) / grain) * grain);
  return {black, black + std::ceil(width / grain + 1.0) * grain};
}

}  // namespace

LightField toEightBit(const LightField& light_field)
{
  LightField result = light_field;
  if (light_field.reference().image.depth() == CV_8U)
  {
    return result;
  }
  const Window window = windowOf(light_field);
  const double scale = 255.0 / (window.white - window.black);
  for (View& view : result.views)
  {
    cv::Mat eight_bit;
    view.image.convertTo(eight_bit, CV_8U, scale, -scale * window.black);
    view.image = eight_bit;
  }
  return result;
}

}  // namespace light_field_depth
