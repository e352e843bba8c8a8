#include "ros/view_quorum.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace light_field_depth
{
ViewQuorum::ViewQuorum(const ViewArray& array, std::size_t min_views)
    : reference_(array.reference), min_views_(min_views > 0 ? min_views : (3 * array.views.size() + 3) / 4)
{
  const GridPosition& centre = array.views[array.reference].grid;
  std::vector<std::vector<std::size_t>> sides(4);  // in the order of on_side
  for (std::size_t view = 0; view < array.views.size(); ++view)
  {
    const GridPosition& grid = array.views[view].grid;
    const bool left = grid.column < centre.column;
    const bool right = grid.column > centre.column;
    const bool above = grid.row < centre.row;
    const bool below = grid.row > centre.row;
    const std::array<bool, 4> on_side = {left, right, above, below};
    for (std::size_t side = 0; side < sides.size(); ++side)
    {
      if (on_side[side])
      {
        sides[side].push_back(view);
      }
    }
  }
  std::copy_if(sides.begin(), sides.end(), std::back_inserter(sides_),
               [](const std::vector<std::size_t>& side) { return !side.empty(); });
}

bool ViewQuorum::isEnough(const std::vector<bool>& present) const
{
  const auto count = static_cast<std::size_t>(std::count(present.begin(), present.end(), true));
  return present[reference_] && count >= std::max<std::size_t>(2, min_views_) &&
         std::all_of(sides_.begin(), sides_.end(),
                     [&](const std::vector<std::size_t>& side) {
                       return std::any_of(side.begin(), side.end(),
                                          [&](std::size_t view) { return present[view]; });
                     });
}

}  // namespace light_field_depth
