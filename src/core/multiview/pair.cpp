#include "core/multiview/pair.h"

#include <cstddef>

namespace light_field_depth::multiview
{
namespace
{
constexpr std::size_t PAIR = 2;  // views
/// Of the large change penalty for arrays. Measured on ETH3D and Middlebury pairs.
constexpr int LARGE_CHANGE_FACTOR = 4;
/// Of the truncation. The full charge makes the foreground spread over what it hides, where the costs of all
/// labels behind it are that charge.
constexpr int UNSEEN_DIVISOR = 2;

std::size_t otherIndex(const LightField& pair)
{
  return PAIR - 1 - pair.reference_index;
}

}  // namespace

bool isPair(const LightField& light_field)
{
  return light_field.views.size() == PAIR;
}

const View& otherView(const LightField& pair)
{
  return pair.views[otherIndex(pair)];
}

LightField turnedRound(const LightField& pair)
{
  LightField turned = pair;
  turned.reference_index = otherIndex(pair);
  View& was_reference = turned.views[pair.reference_index];
  View& other = turned.views[turned.reference_index];
  was_reference.steps = -other.steps;
  was_reference.offset_px = -other.offset_px;
  other.steps = {};
  other.offset_px = {};
  return turned;
}

void adaptToPair(SolverSettings& settings)
{
  settings.search.paths.large_change_penalty *= LARGE_CHANGE_FACTOR;
  settings.search.cost.unseen_penalty = settings.search.cost.truncation / UNSEEN_DIVISOR;
  // One other view tells less than many: ETH3D playground and Middlebury Art have 1.24 and 11.6 % of their
  // pixels off by more than 4 px with the labels and the penalty of many views, 0.92 and 10.9 % with these.
  settings.search.last_large_change_share = 1.0F;
  if (!settings.grey_search)
  {
    settings.search.first_label_step_share = 1.0F;
  }
}

}  // namespace light_field_depth::multiview
