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
/// Of the label step of many views, for realtime: labels 3/4 px apart instead of 1/2. A sixth of the time
/// less for 4.8 instead of 4.0 % of playground and 25.2 instead of 23.8 % of Art off by more than 1 px; the
/// shares off by more than 4 px stay.
constexpr float REALTIME_LABEL_STEP = 1.5F;

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

void adaptToPair(const MultiviewOptions& given, SolverSettings& settings)
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
  if (given.preset == MultiviewPreset::Realtime)
  {
    // A single search of all labels is quicker than one of every second label and another one near it, and
    // better: 0.6 instead of 0.9 % of playground are off by more than 4 px, 13 % of Art either way.
    if (given.visibility_passes == MultiviewOptions::PRESET_NUMBER)
    {
      settings.search.visibility_passes = 0;
    }
    if (given.label_step_px == MultiviewOptions::PRESET_NUMBER)
    {
      settings.label_step_px *= REALTIME_LABEL_STEP;
    }
  }
}

}  // namespace light_field_depth::multiview
