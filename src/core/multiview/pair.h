#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_PAIR_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_PAIR_H

#include "core/multiview/solver.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/multiview_options.h"

namespace light_field_depth::multiview
{
/// Whether the reference has one other view beside it.
bool isPair(const LightField& light_field);

/// The view beside the reference. @pre isPair(pair)
const View& otherView(const LightField& pair);

/// The same pair with the other view as its reference. @pre isPair(pair)
LightField turnedRound(const LightField& pair);

/// Fits what the search assumes to one view beside the reference: smoothness has to bridge what no second
/// view explains, and what the other view cannot see is common rather than the last resort.
/// @param given as the caller gave them, without the numbers of the preset
/// @param settings after adaptToNoise()
void adaptToPair(const MultiviewOptions& given, SolverSettings& settings);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_PAIR_H
