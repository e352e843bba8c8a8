#include "light_field_depth/evaluation/roughness.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
namespace
{
// The definition of the measure; see roughness().
constexpr int BORDER_PX = 12;
constexpr double FINE_PX = 1.5;
constexpr double COARSE_PX = 8.0;
constexpr int WINDOW_PX = 17;
constexpr double FLAT_SHARE = 0.3;

cv::Mat smoothed(const cv::Mat& values, double sigma_px)
{
  cv::Mat result;
  cv::GaussianBlur(values, result, {}, sigma_px);
  return result;
}

/// How much the image changes about each pixel.
cv::Mat changes(const cv::Mat& image)
{
  cv::Mat brightness;
  toGrey(image).convertTo(brightness, CV_32F);
  cv::Mat change = cv::abs(smoothed(brightness, FINE_PX) - smoothed(brightness, COARSE_PX));
  cv::blur(change, change, {WINDOW_PX, WINDOW_PX});
  return change;
}

/// The value below which a share of the values lies.
float quantile(const cv::Mat& values, double share)
{
  std::vector<float> sorted;
  for (int y = 0; y < values.rows; ++y)
  {
    sorted.insert(sorted.end(), values.ptr<float>(y), values.ptr<float>(y) + values.cols);
  }
  const auto at =
      sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

}  // namespace

double roughness(const cv::Mat& disparity, const cv::Mat& image)
{
  if (disparity.type() != CV_32FC1 || disparity.size() != image.size() ||
      std::min(disparity.cols, disparity.rows) <= 2 * BORDER_PX)
  {
    throw InputError(
        "The roughness compares a disparity map of 32-bit floats with an image of the same size, of more "
        "than " +
        std::to_string(2 * BORDER_PX) + " pixels a side.");
  }
  const cv::Mat change = changes(image);
  const cv::Rect inner(BORDER_PX, BORDER_PX, disparity.cols - 2 * BORDER_PX, disparity.rows - 2 * BORDER_PX);
  const float calm = quantile(change(inner), FLAT_SHARE);

  const cv::Mat known = cv::abs(disparity) <= std::numeric_limits<float>::max();  // neither NaN nor infinite
  cv::Mat map(disparity.size(), CV_32FC1, cv::Scalar(0.0));
  cv::Mat share(disparity.size(), CV_32FC1, cv::Scalar(0.0));
  disparity.copyTo(map, known);
  share.setTo(1.0, known);
  cv::Mat rest;
  cv::divide(smoothed(map, COARSE_PX), smoothed(share, COARSE_PX), rest);
  rest = map - rest;

  const cv::Mat flat = (change <= calm) & known;
  const int pixels = cv::countNonZero(flat(inner));
  return pixels > 0 ? cv::norm(rest(inner), cv::NORM_L2, flat(inner)) / std::sqrt(pixels) : 0.0;
}

}  // namespace light_field_depth
