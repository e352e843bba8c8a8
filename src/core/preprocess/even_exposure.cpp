#include "core/preprocess/even_exposure.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace light_field_depth::multiview
{
namespace
{
/// Of the reference's mean brightness. Set by hand: disparity alone changes what a quarter of the view shows
/// more than what the whole view shows.
constexpr double MAX_DIFFERENCE = 0.015;
constexpr double MAX_DIFFERENCE_OF_A_QUARTER = 0.03;
constexpr std::size_t QUARTERS = 4;  // of a view: shading makes them differ

std::array<double, QUARTERS> quarterMeans(const cv::Mat& image)
{
  const cv::Size half(image.cols / 2, image.rows / 2);
  return {cv::mean(image(cv::Rect({0, 0}, half)))[0], cv::mean(image(cv::Rect({half.width, 0}, half)))[0],
          cv::mean(image(cv::Rect({0, half.height}, half)))[0],
          cv::mean(image(cv::Rect({half.width, half.height}, half)))[0]};
}

double meanOf(const std::array<double, QUARTERS>& values)
{
  return 0.25 * (values[0] + values[1] + values[2] + values[3]);
}

}  // namespace

bool looksEvenlyExposed(const LightField& light_field)
{
  const auto reference = quarterMeans(light_field.reference().image);
  const double brightness = std::max(1.0, meanOf(reference));
  return std::all_of(light_field.views.begin(), light_field.views.end(),
                     [&](const View& view)
                     {
                       const auto means = quarterMeans(view.image);
                       double most = 0.0;
                       for (std::size_t i = 0; i < QUARTERS; ++i)
                       {
                         most = std::max(most, std::abs(means[i] - reference[i]));
                       }
                       return most < MAX_DIFFERENCE_OF_A_QUARTER * brightness &&
                              std::abs(meanOf(means) - meanOf(reference)) < MAX_DIFFERENCE * brightness;
                     });
}

}  // namespace light_field_depth::multiview
