#include "core/preprocess/search_bounds.h"

#include <algorithm>

namespace light_field_depth
{
namespace
{
/// Of the side along which a point moves from one view to the other: the displacements of a pair begin with
/// this much. The widest of the pairs of Middlebury and ETH3D reach a sixth.
constexpr float PAIR_FRACTION_OF_SIDE = 0.25F;
/// A far surface at zero is found to about a label, and must not reach the end of the first sweep.
constexpr float PAIR_LABELS_BELOW_ZERO = 3.0F;
/// Less than a third of a view is left to compare with at larger displacements.
constexpr float LARGEST_FRACTION_OF_SIDE = 0.7F;
/// What ends so near to a bound may go on behind it.
constexpr float REACH_LABELS = 1.0F;

}  // namespace

bool isPair(const std::vector<AxisArm>& arms)
{
  return arms.size() == 1 && arms.front().size() == 1;
}

SearchBounds::SearchBounds(const std::vector<AxisArm>& arms, float max_displacement_px, float label_step)
    : usual_(largestDisparity(arms, max_displacement_px)),
      limit_(disparityOfFraction(arms, LARGEST_FRACTION_OF_SIDE))
{
  range_ = {-usual_, usual_};
  if (isPair(arms))
  {
    range_ = {-std::min(PAIR_LABELS_BELOW_ZERO * label_step, usual_),
              disparityOfFraction(arms, PAIR_FRACTION_OF_SIDE)};
  }
}

/// The next bound beyond this one, as a distance from zero.
float SearchBounds::widened(float most) const
{
  return most < usual_ ? usual_ : limit_;
}

bool SearchBounds::widenFor(const DisparityRange& found, float label_step)
{
  const DisparityRange before = range_;
  if (found.min <= before.min + REACH_LABELS * label_step)
  {
    range_.min = -widened(-before.min);
  }
  if (found.max >= before.max - REACH_LABELS * label_step)
  {
    range_.max = widened(before.max);
  }
  return range_.min < before.min || range_.max > before.max;
}

}  // namespace light_field_depth
