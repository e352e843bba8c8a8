#include "light_field_depth/core/mask_sources.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace light_field_depth
{
namespace
{
/// JPEG gives black areas at its usual qualities values up to this.
constexpr double BLACKEST_LEVELS = 4.0;
constexpr double KNOWN = 255.0;

/// 255 where every channel is at most the limit.
cv::Mat blackPixels(const cv::Mat& image)
{
  const double limit = image.depth() == CV_8U ? BLACKEST_LEVELS : 0.0;
  cv::Mat black;
  cv::inRange(image, cv::Scalar::all(0.0), cv::Scalar::all(limit), black);
  return black;
}

/// For each component whether it has a pixel at the border.
std::vector<bool> atBorder(const cv::Mat& labels, int components)
{
  std::vector<bool> found(static_cast<std::size_t>(components), false);
  const auto mark = [&](int y, int x) { found[static_cast<std::size_t>(labels.at<int>(y, x))] = true; };
  for (int x = 0; x < labels.cols; ++x)
  {
    mark(0, x);
    mark(labels.rows - 1, x);
  }
  for (int y = 0; y < labels.rows; ++y)
  {
    mark(y, 0);
    mark(y, labels.cols - 1);
  }
  found[0] = false;  // what is not black
  return found;
}

}  // namespace

cv::Mat blackMask(const cv::Mat& image)
{
  const cv::Mat black = blackPixels(image);
  cv::Mat labels;
  const int components = cv::connectedComponents(black, labels, 4, CV_32S);
  const std::vector<bool> masked = atBorder(labels, components);
  if (std::none_of(masked.begin(), masked.end(), [](bool is_masked) { return is_masked; }))
  {
    return {};
  }
  cv::Mat mask(image.size(), CV_8UC1);
  for (int y = 0; y < mask.rows; ++y)
  {
    const int* const label = labels.ptr<int>(y);
    auto* const row = mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < mask.cols; ++x)
    {
      row[x] = masked[static_cast<std::size_t>(label[x])] ? 0 : static_cast<std::uint8_t>(KNOWN);
    }
  }
  cv::erode(mask, mask, cv::Mat(), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(KNOWN));
  return mask;
}

cv::Mat alphaMask(const cv::Mat& image)
{
  if (image.channels() != 4)
  {
    return {};
  }
  cv::Mat alpha;
  cv::extractChannel(image, alpha, 3);
  const cv::Mat mask = alpha > 0;
  const int known = cv::countNonZero(mask);
  return known == 0 || known == static_cast<int>(mask.total()) ? cv::Mat() : mask;
}

cv::Mat bothKnown(const cv::Mat& a, const cv::Mat& b)
{
  if (a.empty() || b.empty())
  {
    return a.empty() ? b : a;
  }
  return (a != 0) & (b != 0);
}

}  // namespace light_field_depth
