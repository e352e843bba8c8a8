#include "core/preprocess/layout_views.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace light_field_depth
{
namespace
{
/// Signed grid steps from the reference along the row (or column); 0 for views that are not on it.
int stepsAlong(const LightField& light_field, const View& view, bool row)
{
  const GridPosition& reference = light_field.reference().grid;
  const int columns = view.grid.column - reference.column;
  const int rows = view.grid.row - reference.row;
  return row ? (rows == 0 ? columns : 0) : (columns == 0 ? rows : 0);
}

double positionAlong(const View& view, bool row)
{
  return row ? view.steps.x : view.steps.y;
}

/// Grid steps from the reference to the farthest view on the line.
int reachOf(const LightField& light_field, bool row)
{
  int reach = 0;
  for (const View& view : light_field.views)
  {
    reach = std::max(reach, std::abs(stepsAlong(light_field, view, row)));
  }
  return reach;
}

}  // namespace

LineViews viewsOnLine(const LightField& light_field, bool row, int distance)
{
  LineViews pair;
  for (const int side : {1, -1})
  {
    std::size_t best = light_field.views.size();
    int least = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < light_field.views.size(); ++i)
    {
      const int steps = side * stepsAlong(light_field, light_field.views[i], row);
      const bool apart = std::abs(positionAlong(light_field.views[i], row)) > 1e-6;
      if (steps > 0 && apart && std::abs(steps - distance) < least)
      {
        least = std::abs(steps - distance);
        best = i;
      }
    }
    if (best < light_field.views.size())
    {
      pair.indices.push_back(best);
      pair.units.push_back(static_cast<float>(positionAlong(light_field.views[best], row) / distance));
    }
  }
  return pair;
}

std::vector<int> layoutDistances(const LightField& light_field)
{
  const int row_reach = reachOf(light_field, true);
  const int column_reach = reachOf(light_field, false);
  const int reach = std::min(row_reach, column_reach) > 0 ? std::min(row_reach, column_reach)
                                                          : std::max(row_reach, column_reach);
  std::vector<int> distances;
  if (reach > 0)
  {
    distances = {1, std::max(1, (reach + 1) / 2), reach};
    distances.erase(std::unique(distances.begin(), distances.end()), distances.end());
  }
  return distances;
}

}  // namespace light_field_depth
