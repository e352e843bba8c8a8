#include "core/paper2017/disparity_fusion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <opencv2/imgproc.hpp>

namespace light_field_depth
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;
/// Mean deviation from the median, in pixels per grid step, at which the confidence has fallen to 1/e.
constexpr float SPREAD_SCALE_PX = 0.15F;

struct Sample
{
  float disparity;
  float confidence;
};

struct Fused
{
  float disparity;
  float confidence;
};

Fused fuse(std::vector<Sample>& samples, std::size_t map_count)
{
  if (samples.empty())
  {
    return {std::numeric_limits<float>::quiet_NaN(), 0.0F};
  }
  const auto nearer = [](const Sample& a, const Sample& b) { return a.disparity < b.disparity; };
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end(), nearer);
  float median = middle->disparity;
  if (samples.size() % 2 == 0)
  {
    median = 0.5F * (median + std::max_element(samples.begin(), middle, nearer)->disparity);
  }
  float spread = 0.0F;
  float support = 0.0F;
  for (const Sample& sample : samples)
  {
    spread += std::abs(sample.disparity - median);
    support += sample.confidence;
  }
  // The support is summed over the samples and divided by the number of maps, so it contains the coverage.
  spread /= static_cast<float>(samples.size());
  support /= static_cast<float>(map_count);
  return {median, std::clamp(support * std::exp(-spread / SPREAD_SCALE_PX), 0.0F, 1.0F)};
}

/// CV_8UC1: 255 where the value is not finite. A comparison of a matrix with itself does not find NaN with
/// every build of OpenCV.
cv::Mat notFinite(const cv::Mat& values)
{
  cv::Mat mask(values.size(), CV_8UC1);
  for (int y = 0; y < values.rows; ++y)
  {
    const auto* const in = values.ptr<float>(y);
    auto* const out = mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < values.cols; ++x)
    {
      out[x] = std::isfinite(in[x]) ? 0 : 255;
    }
  }
  return mask;
}

/// Moves each pixel by disparity * steps + offset; where several land on one, the nearest surface stays.
DenseDisparity warpBy(const DenseDisparity& map, const cv::Point2f& steps, const cv::Point2f& offset)
{
  const cv::Size size = map.disparity.size();
  DenseDisparity warped{cv::Mat(size, CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN())),
                        cv::Mat::zeros(size, CV_32FC1)};
  for (int y = 0; y < size.height; ++y)
  {
    const auto* const disparities = map.disparity.ptr<float>(y);
    const auto* const confidences = map.confidence.ptr<float>(y);
    for (int x = 0; x < size.width; ++x)
    {
      const float disparity = disparities[x];
      const int column = cvRound(static_cast<float>(x) + disparity * steps.x + offset.x);
      const int row = cvRound(static_cast<float>(y) + disparity * steps.y + offset.y);
      if (confidences[x] <= 0.0F || column < 0 || row < 0 || column >= size.width || row >= size.height)
      {
        continue;
      }
      float& target = warped.disparity.at<float>(row, column);
      if (!(target >= disparity))
      {
        target = disparity;
        warped.confidence.at<float>(row, column) = confidences[x];
      }
    }
  }
  return warped;
}

}  // namespace

DenseDisparity warpToReference(const DenseDisparity& map, const View& view)
{
  return warpBy(map, cv::Point2f(view.steps), cv::Point2f(-view.offset_px));
}

DenseDisparity warpFromReference(const DenseDisparity& map, const View& view)
{
  return warpBy(map, cv::Point2f(-view.steps), cv::Point2f(view.offset_px));
}

FusedDisparity fuseByMedian(const std::vector<DenseDisparity>& maps, ThreadPool& pool)
{
  const cv::Size size = maps.front().disparity.size();
  FusedDisparity fused{cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32FC1)};
  pool.parallelFor(0, size.height, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     std::vector<Sample> samples;
                     samples.reserve(maps.size());
                     for (int y = first; y < last; ++y)
                     {
                       for (int x = 0; x < size.width; ++x)
                       {
                         samples.clear();
                         for (const DenseDisparity& map : maps)
                         {
                           const float disparity = map.disparity.at<float>(y, x);
                           if (std::isfinite(disparity))
                           {
                             samples.push_back({disparity, map.confidence.at<float>(y, x)});
                           }
                         }
                         const Fused result = fuse(samples, maps.size());
                         fused.disparity.at<float>(y, x) = result.disparity;
                         fused.confidence.at<float>(y, x) = result.confidence;
                       }
                     }
                   });
  fillFromNearest(fused.disparity);
  return fused;
}

void fillFromNearest(cv::Mat& values)
{
  const cv::Mat missing = notFinite(values);
  const int missing_count = cv::countNonZero(missing);
  if (missing_count == static_cast<int>(missing.total()))
  {
    values.setTo(0.0);
    return;
  }
  if (missing_count == 0)
  {
    return;
  }
  cv::Mat distance;
  cv::Mat labels;
  cv::distanceTransform(missing, distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<float> value_of_label(values.total() + 1);
  for (int y = 0; y < values.rows; ++y)
  {
    for (int x = 0; x < values.cols; ++x)
    {
      if (missing.at<std::uint8_t>(y, x) == 0)
      {
        value_of_label[static_cast<std::size_t>(labels.at<int>(y, x))] = values.at<float>(y, x);
      }
    }
  }
  for (int y = 0; y < values.rows; ++y)
  {
    for (int x = 0; x < values.cols; ++x)
    {
      values.at<float>(y, x) = value_of_label[static_cast<std::size_t>(labels.at<int>(y, x))];
    }
  }
}

}  // namespace light_field_depth
