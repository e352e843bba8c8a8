#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_SPREAD_VIEWS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_SPREAD_VIEWS_H

#include <cstddef>
#include <vector>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// So many views that stand as far apart as may be: the reference, then each time the view that is farthest
/// from those there are. Of a cross these are its ends, of a grid its corners, in a row both ends.
/// @return indices of views, the reference first; fewer than `count` where there are no more views
std::vector<std::size_t> spreadViews(const LightField& light_field, std::size_t count);

/// The same views with another one as the reference: steps and offsets are relative to it.
LightField turnedTo(const LightField& light_field, std::size_t reference_index);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_SPREAD_VIEWS_H
