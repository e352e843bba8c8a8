#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_REACH_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_REACH_H

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// Refuses a range of disparities that the views cannot tell apart, before memory and time grow with it:
/// beyond what even the nearest view shows, or so wide that the farthest view leaves its image many times
/// over between the ends.
/// @throw InputError a sentence that names the range, the view and what to do
void checkReach(const DisparityRange& range, const LightField& light_field);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_REACH_H
