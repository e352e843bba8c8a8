#include "light_field_depth/io/disparity_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace light_field_depth
{
namespace
{
// Set by hand, for the eye: single outliers do not take the colours of all others.
constexpr double LOW_PERCENTILE = 0.005;
constexpr double HIGH_PERCENTILE = 0.995;
constexpr float MIN_SPAN_PX = 0.01F;
const cv::Scalar UNKNOWN_COLOR(128, 128, 128);

// The layout of the scale and of the panels, set by eye.
constexpr int SCALE_WIDTH_PX = 92;
constexpr int BAR_LEFT_PX = 8;
constexpr int BAR_WIDTH_PX = 14;
constexpr int BAR_MARGIN_PX = 10;
constexpr int LABEL_LEFT_PX = BAR_LEFT_PX + BAR_WIDTH_PX + 5;
constexpr int LABEL_RISE_PX = 4;
constexpr int LABEL_DISTANCE_PX = 60;
constexpr double FONT_SCALE = 0.38;
constexpr int CAPTION_HEIGHT_PX = 16;
constexpr int PANEL_GAP_PX = 8;

std::string label(double value_px)
{
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%+.2f", value_px);
  return text.data();
}

/// The bar alone: the largest disparity on top.
cv::Mat scaleBar(int height, const DisparityRange& range)
{
  cv::Mat values(height, BAR_WIDTH_PX, CV_32FC1);
  for (int y = 0; y < height; ++y)
  {
    const float fraction = 1.0F - static_cast<float>(y) / static_cast<float>(std::max(1, height - 1));
    values.row(y).setTo(range.min + fraction * (range.max - range.min));
  }
  return colorizeDisparity(values, range);
}

void drawLabels(cv::Mat& canvas, int left, int top, int height, const DisparityRange& range)
{
  const int intervals = std::clamp(height / LABEL_DISTANCE_PX, 1, 8);
  for (int i = 0; i <= intervals; ++i)
  {
    const double fraction = static_cast<double>(i) / intervals;
    const int y = top + static_cast<int>(std::lround(fraction * (height - 1)));
    const double value = range.max + fraction * (range.min - range.max);
    cv::line(canvas, {left + BAR_LEFT_PX + BAR_WIDTH_PX, y}, {left + LABEL_LEFT_PX - 2, y},
             cv::Scalar::all(0));
    cv::putText(canvas, label(value) + (i == 0 ? " px" : ""), {left + LABEL_LEFT_PX, y + LABEL_RISE_PX},
                cv::FONT_HERSHEY_SIMPLEX, FONT_SCALE, cv::Scalar::all(0), 1, cv::LINE_AA);
  }
}

/// Any view in 8 bits of colour.
cv::Mat eightBitColour(const cv::Mat& image)
{
  LightField single;
  single.views.push_back(gridView(0, 0, image));
  cv::Mat levels = toEightBit(single).views.front().image;
  if (levels.channels() == 1)
  {
    cv::cvtColor(levels, levels, cv::COLOR_GRAY2BGR);
  }
  return levels;
}

cv::Mat withCaption(const cv::Mat& image, const std::string& caption)
{
  cv::Mat panel(image.rows + CAPTION_HEIGHT_PX, image.cols + PANEL_GAP_PX, CV_8UC3, cv::Scalar::all(255));
  image.copyTo(panel(cv::Rect({0, CAPTION_HEIGHT_PX}, image.size())));
  cv::putText(panel, caption, {2, CAPTION_HEIGHT_PX - LABEL_RISE_PX}, cv::FONT_HERSHEY_SIMPLEX, FONT_SCALE,
              cv::Scalar::all(0), 1, cv::LINE_AA);
  return panel;
}

}  // namespace

DisparityRange shownRange(const cv::Mat& disparity)
{
  std::vector<float> values;
  values.reserve(disparity.total());
  for (int y = 0; y < disparity.rows; ++y)
  {
    const auto* const row = disparity.ptr<float>(y);
    std::copy_if(row, row + disparity.cols, std::back_inserter(values),
                 [](float value) { return std::isfinite(value); });
  }
  if (values.empty())
  {
    return {0.0F, 1.0F};
  }
  const auto percentile = [&](double fraction)
  {
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  const float low = percentile(LOW_PERCENTILE);
  const float high = percentile(HIGH_PERCENTILE);
  const float middle = 0.5F * (low + high);
  const float half = std::max(0.5F * (high - low), 0.5F * MIN_SPAN_PX);
  return {middle - half, middle + half};
}

cv::Mat colorizeDisparity(const cv::Mat& disparity, const DisparityRange& range)
{
  cv::Mat levels(disparity.size(), CV_8UC1);
  cv::Mat unknown(disparity.size(), CV_8UC1);
  const float scale = 255.0F / (range.max - range.min);
  for (int y = 0; y < disparity.rows; ++y)
  {
    for (int x = 0; x < disparity.cols; ++x)
    {
      const float value = disparity.at<float>(y, x);
      const bool finite = std::isfinite(value);
      const float level = finite ? (value - range.min) * scale : 0.0F;
      levels.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(level);
      unknown.at<std::uint8_t>(y, x) = finite ? 0 : 255;
    }
  }
  cv::Mat colors;
  cv::applyColorMap(levels, colors, cv::COLORMAP_TURBO);
  colors.setTo(UNKNOWN_COLOR, unknown);
  return colors;
}

cv::Mat disparityWithScale(const cv::Mat& disparity, const DisparityRange& range)
{
  cv::Mat canvas(disparity.rows, disparity.cols + SCALE_WIDTH_PX, CV_8UC3, cv::Scalar::all(255));
  colorizeDisparity(disparity, range).copyTo(canvas(cv::Rect({0, 0}, disparity.size())));
  const int bar_height = std::max(1, disparity.rows - 2 * BAR_MARGIN_PX);
  const int top = (disparity.rows - bar_height) / 2;
  scaleBar(bar_height, range)
      .copyTo(canvas(cv::Rect(disparity.cols + BAR_LEFT_PX, top, BAR_WIDTH_PX, bar_height)));
  drawLabels(canvas, disparity.cols, top, bar_height, range);
  return canvas;
}

cv::Mat previewImage(const cv::Mat& reference, const cv::Mat& disparity, const cv::Mat& confidence)
{
  cv::Mat levels;
  confidence.convertTo(levels, CV_8U, 255.0);
  cv::cvtColor(levels, levels, cv::COLOR_GRAY2BGR);
  cv::Mat preview;
  cv::hconcat(
      std::vector<cv::Mat>{withCaption(eightBitColour(reference), "reference view"),
                           withCaption(disparityWithScale(disparity, shownRange(disparity)), "disparity"),
                           withCaption(levels, "confidence")},
      preview);
  return preview;
}

}  // namespace light_field_depth
