#include "core/light_field/spread_views.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace light_field_depth
{
std::vector<std::size_t> spreadViews(const LightField& light_field, std::size_t count)
{
  const std::vector<View>& views = light_field.views;
  std::vector<std::size_t> chosen = {light_field.reference_index};
  const auto distance = [&](std::size_t a, std::size_t b)
  { return std::hypot(views[a].steps.x - views[b].steps.x, views[a].steps.y - views[b].steps.y); };
  while (chosen.size() < std::min(count, views.size()))
  {
    std::size_t best = 0;
    double best_gap = 0.0;
    double best_sum = 0.0;
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      double gap = std::numeric_limits<double>::infinity();
      double sum = 0.0;
      for (const std::size_t other : chosen)
      {
        gap = std::min(gap, distance(i, other));
        sum += distance(i, other);
      }
      // Of views that are as far from the nearest the one that is opposite to the others.
      constexpr double rounding = 1e-9;
      if (gap > best_gap + rounding || (gap > best_gap - rounding && sum > best_sum + rounding))
      {
        best = i;
        best_gap = gap;
        best_sum = sum;
      }
    }
    if (best_gap <= 0.0)
    {
      break;  // the others stand where a chosen one does
    }
    chosen.push_back(best);
  }
  return chosen;
}

LightField turnedTo(const LightField& light_field, std::size_t reference_index)
{
  LightField turned = light_field;
  const View& reference = light_field.views[reference_index];
  for (View& view : turned.views)
  {
    view.steps -= reference.steps;
    view.offset_px -= reference.offset_px;
  }
  turned.reference_index = reference_index;
  return turned;
}

}  // namespace light_field_depth
