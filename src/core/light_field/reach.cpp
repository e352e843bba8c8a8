#include "core/light_field/reach.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
/// A view that moves by more than this over the range shows a pixel of the reference in less than a sixtieth
/// of it, which is a few of the solver's labels (at most 240 of them). A row of 100 views that is searched as
/// far as its nearest views see anything stays below it.
constexpr double MOST_IMAGES_OF_MOTION = 64.0;

/// Disparity at which even the nearest view has nothing of the reference view in its image any more.
double largestVisibleDisparity(const LightField& light_field)
{
  const double side_px = std::max(light_field.size().width, light_field.size().height);
  double largest_px = 0.0;
  for (const View& view : light_field.views)
  {
    const double steps = std::max(std::abs(view.steps.x), std::abs(view.steps.y));
    const double offset_px = std::max(std::abs(view.offset_px.x), std::abs(view.offset_px.y));
    if (steps > 0.0)
    {
      largest_px = std::max(largest_px, (side_px + offset_px) / steps);
    }
  }
  return largest_px;
}

double distanceOf(const View& view)
{
  return std::hypot(view.steps.x, view.steps.y);
}

/// Of the view that is nearest to the reference, but not at its place.
const View& nearestView(const LightField& light_field)
{
  const View* nearest = nullptr;
  for (const View& view : light_field.views)
  {
    const bool apart = distanceOf(view) > 1e-9;
    if (apart && (nearest == nullptr || distanceOf(view) < distanceOf(*nearest)))
    {
      nearest = &view;
    }
  }
  return nearest == nullptr ? light_field.reference() : *nearest;
}

}  // namespace

void checkReach(const DisparityRange& range, const LightField& light_field)
{
  const cv::Size size = light_field.size();
  const double largest_px = largestVisibleDisparity(light_field);
  if (range.min < -largest_px || range.max > largest_px)
  {
    std::ostringstream text;
    text << "disparity_range is " << range.min << ".." << range.max << " px, but beyond " << largest_px
         << " px either way no view shows what the reference view of " << size.width << " x " << size.height
         << " pixels does; give a range within that.";
    throw InputError(text.str());
  }
  const double extent_px = static_cast<double>(range.max) - static_cast<double>(range.min);
  for (const View& view : light_field.views)
  {
    const double images =
        extent_px * std::max(std::abs(view.steps.x) / size.width, std::abs(view.steps.y) / size.height);
    if (images > MOST_IMAGES_OF_MOTION)
    {
      const View& nearest = nearestView(light_field);
      std::ostringstream text;
      text << "Over the disparities " << range.min << ".." << range.max << " px, view " << toString(view.grid)
           << " moves by " << images << " times its side, and at most " << MOST_IMAGES_OF_MOTION
           << " can be searched: it stands " << distanceOf(view) << " steps from the reference, and view "
           << toString(nearest.grid) << " only " << distanceOf(nearest)
           << ". Check these positions, leave one of the two views out, or give a narrower disparity_range.";
      throw InputError(text.str());
    }
  }
}

}  // namespace light_field_depth
