#include "light_field_depth/core/paper2017_estimator.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace light_field_depth
{
namespace
{
cv::Mat toGrey(const cv::Mat& image)
{
  if (image.channels() == 1)
  {
    return image;
  }
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

/// Disparity from the flow of the reference view to one other view, projected on the epipolar line.
cv::Mat disparityFromFlow(const cv::Mat& flow, const View& view)
{
  const cv::Point2d steps = view.steps;
  const double norm = steps.dot(steps);
  cv::Mat disparity(flow.size(), CV_32FC1);
  for (int y = 0; y < flow.rows; ++y)
  {
    for (int x = 0; x < flow.cols; ++x)
    {
      const auto& f = flow.at<cv::Vec2f>(y, x);
      disparity.at<float>(y, x) = static_cast<float>(
          -((f[0] - view.offset_px.x) * steps.x + (f[1] - view.offset_px.y) * steps.y) / norm);
    }
  }
  return disparity;
}

}  // namespace

std::vector<std::string> validate(const Paper2017Options& /*options*/)
{
  return {};
}

Paper2017Estimator::Paper2017Estimator(Paper2017Options options) : options_(options) {}

DisparityEstimate Paper2017Estimator::estimate(const LightField& light_field, const EstimateRequest& request,
                                               RunContext& context)
{
  const LightField field = toEightBit(
      selectViews(light_field, request.views == ViewSelection::Auto ? ViewSelection::Cross : request.views));
  const StageTimer timer(context, "flow");
  const cv::Mat reference = toGrey(field.reference().image);
  std::vector<cv::Mat> maps;
  for (std::size_t i = 0; i < field.views.size(); ++i)
  {
    if (i != field.reference_index)
    {
      cv::Mat flow;
      cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)
          ->calc(reference, toGrey(field.views[i].image), flow);
      maps.push_back(disparityFromFlow(flow, field.views[i]));
    }
  }
  DisparityEstimate estimate;
  estimate.disparity.create(field.size(), CV_32FC1);
  estimate.confidence = cv::Mat::ones(field.size(), CV_32FC1);
  std::vector<float> values(maps.size());
  for (int y = 0; y < field.size().height; ++y)
  {
    for (int x = 0; x < field.size().width; ++x)
    {
      for (std::size_t i = 0; i < maps.size(); ++i)
      {
        values[i] = maps[i].at<float>(y, x);
      }
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      estimate.disparity.at<float>(y, x) = *middle;
    }
  }
  double minimum = 0.0;
  double maximum = 0.0;
  cv::minMaxIdx(estimate.disparity, &minimum, &maximum);
  estimate.range = request.disparity_range.value_or(
      DisparityRange{static_cast<float>(minimum), static_cast<float>(maximum)});
  estimate.views_used = field.views.size();
  return estimate;
}

}  // namespace light_field_depth
