#include "evaluation/scored_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
constexpr int MAX_BORDER_PX = 65536;  // wider than any image, so that sums stay whole numbers
/// Of a pixel without a value: the range of the truth, but a flat truth makes it no better than a bad one.
constexpr float LEAST_ERROR_OF_UNKNOWN_PX = 1.0F;

std::string sizeText(const cv::Size& size)
{
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

void checkSizes(const cv::Mat& result, const cv::Mat& truth, const cv::Mat& mask, int border_px)
{
  CV_Assert(result.type() == CV_32FC1 && truth.type() == CV_32FC1 &&
            (mask.empty() || mask.type() == CV_8UC1));
  if (result.cols > truth.cols || result.rows > truth.rows)
  {
    throw InputError("The result has " + sizeText(result.size()) +
                     " pixels and is larger than the truth with " + sizeText(truth.size()) +
                     "; compare maps of the same light field.");
  }
  if (!mask.empty() && mask.size() != truth.size())
  {
    throw InputError("The mask has " + sizeText(mask.size()) + " pixels, the truth " +
                     sizeText(truth.size()) + "; give a mask in the size of the truth.");
  }
  if (border_px < 0 || border_px > MAX_BORDER_PX)
  {
    throw InputError("The border is " + std::to_string(border_px) + " px; it must be between 0 and " +
                     std::to_string(MAX_BORDER_PX) + ".");
  }
}

/// The pixels of the truth that are scored: those of the result that are not within the border.
cv::Rect scoredArea(const cv::Size& result_size, const cv::Size& truth_size, int border_px)
{
  const cv::Point margin((truth_size.width - result_size.width) / 2,
                         (truth_size.height - result_size.height) / 2);
  const cv::Point cut(std::max(border_px - margin.x, 0), std::max(border_px - margin.y, 0));
  const cv::Rect area(margin + cut, result_size - cv::Size(2 * cut.x, 2 * cut.y));
  if (area.width <= 0 || area.height <= 0)
  {
    throw InputError("A border of " + std::to_string(border_px) + " px leaves nothing of a map of " +
                     sizeText(result_size) + " pixels; choose a smaller one.");
  }
  return area;
}

float finiteSpan(const cv::Mat& truth)
{
  float low = std::numeric_limits<float>::infinity();
  float high = -low;
  for (int y = 0; y < truth.rows; ++y)
  {
    for (int x = 0; x < truth.cols; ++x)
    {
      const float value = truth.at<float>(y, x);
      if (std::isfinite(value))
      {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  }
  return high - low;
}

}  // namespace

ScoredPixels scorePixels(const cv::Mat& result, const cv::Mat& truth, const cv::Mat& mask, int border_px)
{
  checkSizes(result, truth, mask, border_px);
  const cv::Rect area = scoredArea(result.size(), truth.size(), border_px);
  const cv::Point margin((truth.cols - result.cols) / 2, (truth.rows - result.rows) / 2);
  const float worst = std::max(finiteSpan(truth(area)), LEAST_ERROR_OF_UNKNOWN_PX);
  ScoredPixels scored;
  scored.errors.reserve(static_cast<std::size_t>(area.area()));
  scored.positions.reserve(static_cast<std::size_t>(area.area()));
  for (int y = area.y; y < area.y + area.height; ++y)
  {
    for (int x = area.x; x < area.x + area.width; ++x)
    {
      const float expected = truth.at<float>(y, x);
      if (!std::isfinite(expected) || (!mask.empty() && mask.at<std::uint8_t>(y, x) == 0))
      {
        continue;
      }
      const cv::Point position = cv::Point(x, y) - margin;
      const float value = result.at<float>(position);
      scored.errors.push_back(std::isfinite(value) ? std::abs(value - expected) : worst);
      scored.positions.push_back(position);
      scored.known += std::isfinite(value) ? 1 : 0;
    }
  }
  if (scored.errors.empty())
  {
    throw InputError("The mask and the truth leave no pixel to score; check that they belong together.");
  }
  return scored;
}

}  // namespace light_field_depth
