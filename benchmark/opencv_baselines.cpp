#include "opencv_baselines.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <opencv2/calib3d.hpp>
#include <opencv2/video/tracking.hpp>

#include "light_field_depth/core/error.h"

namespace light_field_depth::benchmark
{
namespace
{
constexpr float UNKNOWN = std::numeric_limits<float>::quiet_NaN();
constexpr int LABEL_MULTIPLE = 16;  // OpenCV's matchers search a multiple of 16 whole pixels
constexpr float SUBPIXEL_STEPS = 16.0F;

cv::Mat disparityFromFlow(const cv::Mat& flow, const cv::Point2d& steps)
{
  const double norm = steps.dot(steps);
  cv::Mat disparity;
  cv::transform(flow, disparity,
                cv::Matx12f(static_cast<float>(-steps.x / norm), static_cast<float>(-steps.y / norm)));
  return disparity;
}

cv::Mat perPixelMedian(const std::vector<cv::Mat>& maps)
{
  cv::Mat median(maps.front().size(), CV_32FC1);
  std::vector<float> values(maps.size());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  for (int y = 0; y < median.rows; ++y)
  {
    for (int x = 0; x < median.cols; ++x)
    {
      for (std::size_t i = 0; i < maps.size(); ++i)
      {
        values[i] = maps[i].at<float>(y, x);
      }
      std::nth_element(values.begin(), middle, values.end());
      median.at<float>(y, x) = *middle;
    }
  }
  return median;
}

struct WidestPair
{
  const View* left = nullptr;
  const View* right = nullptr;
  double span() const { return right->steps.x - left->steps.x; }
};

WidestPair widestPairOfReferenceRow(const LightField& light_field)
{
  WidestPair pair;
  for (const View& view : light_field.views)
  {
    if (view.grid.row != light_field.reference().grid.row)
    {
      continue;
    }
    pair.left = pair.left == nullptr || view.steps.x < pair.left->steps.x ? &view : pair.left;
    pair.right = pair.right == nullptr || view.steps.x > pair.right->steps.x ? &view : pair.right;
  }
  if (pair.left == nullptr || pair.span() <= 0.0)
  {
    throw InputError("The row of the reference view has no second view; the stereo matchers need one.");
  }
  return pair;
}

/// Shifts the matches of the left view to where the reference view sees them; the nearest wins.
cv::Mat bringToReference(const cv::Mat& raw, const WidestPair& pair, float invalid_below)
{
  const auto span = static_cast<float>(pair.span());
  cv::Mat result(raw.size(), CV_32FC1, cv::Scalar(UNKNOWN));
  for (int y = 0; y < raw.rows; ++y)
  {
    for (int x = 0; x < raw.cols; ++x)
    {
      const float moved = static_cast<float>(raw.at<std::int16_t>(y, x)) / SUBPIXEL_STEPS;
      if (moved < invalid_below)
      {
        continue;
      }
      const float disparity = moved / span;
      const int target = static_cast<int>(std::lround(x + pair.left->steps.x * disparity));
      if (target >= 0 && target < raw.cols)
      {
        float& value = result.at<float>(y, target);
        value = std::isnan(value) ? disparity : std::max(value, disparity);
      }
    }
  }
  return result;
}

struct LabelRange
{
  int min;
  int count;
};

LabelRange labelRange(const DisparityRange& range, double span)
{
  const int min = static_cast<int>(std::floor(range.min * span));
  const int max = static_cast<int>(std::ceil(range.max * span)) + 1;
  return {min, (max - min + LABEL_MULTIPLE - 1) / LABEL_MULTIPLE * LABEL_MULTIPLE};
}

}  // namespace

cv::Mat disMedian(const LightField& light_field)
{
  const LightField cross = toEightBit(selectViews(light_field, ViewSelection::Cross));
  const cv::Mat reference = toGrey(cross.reference().image);
  const cv::Ptr<cv::DISOpticalFlow> dis = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
  dis->setFinestScale(0);
  std::vector<cv::Mat> maps;
  for (std::size_t i = 0; i < cross.views.size(); ++i)
  {
    if (i != cross.reference_index)
    {
      cv::Mat flow;
      dis->calc(reference, toGrey(cross.views[i].image), flow);
      maps.push_back(disparityFromFlow(flow, cross.views[i].steps));
    }
  }
  return perPixelMedian(maps);
}

cv::Mat semiGlobalWidestPair(const LightField& light_field, const DisparityRange& range)
{
  const LightField field = toEightBit(light_field);
  const WidestPair pair = widestPairOfReferenceRow(field);
  const LabelRange labels = labelRange(range, pair.span());
  constexpr int BLOCK = 3;
  const auto matcher =
      cv::StereoSGBM::create(labels.min, labels.count, BLOCK, 8 * 3 * BLOCK * BLOCK, 32 * 3 * BLOCK * BLOCK,
                             1, 0, 0, 0, 0, cv::StereoSGBM::MODE_SGBM_3WAY);
  cv::Mat raw;
  matcher->compute(pair.left->image, pair.right->image, raw);
  return bringToReference(raw, pair, static_cast<float>(labels.min));
}

cv::Mat blockMatchingWidestPair(const LightField& light_field, const DisparityRange& range)
{
  const LightField field = toEightBit(light_field);
  const WidestPair pair = widestPairOfReferenceRow(field);
  const LabelRange labels = labelRange(range, pair.span());
  constexpr int BLOCK = 15;
  const auto matcher = cv::StereoBM::create(labels.count, BLOCK);
  matcher->setMinDisparity(labels.min);
  cv::Mat raw;
  matcher->compute(toGrey(pair.left->image), toGrey(pair.right->image), raw);
  return bringToReference(raw, pair, static_cast<float>(labels.min));
}

}  // namespace light_field_depth::benchmark
