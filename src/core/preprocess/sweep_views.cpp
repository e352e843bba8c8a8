#include "core/preprocess/sweep_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "core/light_field/half_resolution.h"
#include "light_field_depth/core/noise_estimate.h"

namespace light_field_depth
{
namespace
{
/// The nearest, the farthest and one half-way between them.
AxisArm thinOut(AxisArm arm)
{
  std::stable_sort(arm.begin(), arm.end(),
                   [](const View* a, const View* b) { return distanceOf(*a) < distanceOf(*b); });
  return arm.size() <= 3 ? arm : AxisArm{arm.front(), arm[arm.size() / 2], arm.back()};
}

}  // namespace

double distanceOf(const View& view)
{
  return std::hypot(view.steps.x, view.steps.y);
}

std::vector<AxisArm> axisArmsOf(const LightField& light_field)
{
  constexpr double ON_AXIS = 0.05;  // of the distance: three degrees
  for (const bool on_axis_only : {true, false})
  {
    std::array<AxisArm, 4> arms;
    for (const View& view : light_field.views)
    {
      const double along = std::max(std::abs(view.steps.x), std::abs(view.steps.y));
      const double across = std::min(std::abs(view.steps.x), std::abs(view.steps.y));
      if (along < 1e-9 || (on_axis_only && across > ON_AXIS * along))
      {
        continue;
      }
      const bool horizontal = std::abs(view.steps.x) >= std::abs(view.steps.y);
      const bool positive = (horizontal ? view.steps.x : view.steps.y) > 0;
      arms[(horizontal ? 0U : 2U) + (positive ? 0U : 1U)].push_back(&view);
    }
    std::vector<AxisArm> filled;
    for (AxisArm& arm : arms)
    {
      if (!arm.empty())
      {
        filled.push_back(thinOut(std::move(arm)));
      }
    }
    if (!filled.empty())
    {
      return filled;
    }
  }
  return {};
}

double nearestDistance(const std::vector<AxisArm>& arms)
{
  double nearest = std::numeric_limits<double>::max();
  for (const AxisArm& arm : arms)
  {
    nearest = std::min(nearest, distanceOf(*arm.front()));
  }
  return nearest;
}

double farthestDistance(const std::vector<AxisArm>& arms)
{
  double farthest = 0.0;
  for (const AxisArm& arm : arms)
  {
    farthest = std::max(farthest, distanceOf(*arm.back()));
  }
  return farthest;
}

float disparityOfFraction(const std::vector<AxisArm>& arms, double fraction_of_side)
{
  double most = std::numeric_limits<double>::max();
  for (const AxisArm& arm : arms)
  {
    const View& nearest = *arm.front();
    const bool horizontal = std::abs(nearest.steps.x) >= std::abs(nearest.steps.y);
    const int side = horizontal ? nearest.image.cols : nearest.image.rows;
    most = std::min(most, fraction_of_side * side / distanceOf(nearest));
  }
  return static_cast<float>(most);
}

float largestDisparity(const std::vector<AxisArm>& arms, float max_displacement_px)
{
  constexpr double MAX_FRACTION_OF_SIDE = 0.4;  // most of a view must still be compared
  return std::min(static_cast<float>(max_displacement_px / nearestDistance(arms)),
                  disparityOfFraction(arms, MAX_FRACTION_OF_SIDE));
}

double largestDistance(const DisparityRange& range, double pixels_per_label)
{
  /// Of 384 x 384 pixels, the largest images that are swept: 600 MB. A pair has 1075 at the most.
  constexpr double MAX_LABELS = 2048.0;
  const double extent = static_cast<double>(range.max) - static_cast<double>(range.min);
  return extent > 0.0 ? MAX_LABELS * pixels_per_label / extent : std::numeric_limits<double>::max();
}

int halvingsFor(const cv::Size& size, int side_px)
{
  constexpr int MIN_SIDE_PX = 16;  // as in makeLightField()
  int halvings = 0;
  while (std::max(size.width, size.height) >> (halvings + 1) >= side_px &&
         std::min(size.width, size.height) >> (halvings + 1) >= MIN_SIDE_PX)
  {
    ++halvings;
  }
  return halvings;
}

cv::Mat halve(const cv::Mat& image, int times)
{
  cv::Mat result = image;
  for (int i = 0; i < times; ++i)
  {
    cv::Mat half;
    multiview::halveChannels(result, half);
    result = half;
  }
  return result;
}

int blurFor(const cv::Mat& image)
{
  // A sweep's cost of a perfect match is a grey level or so. The kernels 1 2 1 and 1 4 6 4 1 leave 3/8 and
  // 70/256 of the noise.
  constexpr float SLIGHT_NOISE = 1.0F;
  constexpr float STRONG_NOISE = 2.0F;
  const float noise = estimateNoise(image);
  return noise < SLIGHT_NOISE ? 1 : noise < STRONG_NOISE ? 3 : 5;
}

cv::Mat blurred(const cv::Mat& image, int kernel_side)
{
  if (kernel_side <= 1)
  {
    return image;
  }
  cv::Mat result;  // must not share the pixels of the image, which may be the caller's
  cv::GaussianBlur(image, result, cv::Size(kernel_side, kernel_side), 0.0);
  return result;
}

}  // namespace light_field_depth
