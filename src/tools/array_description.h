#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_ARRAY_DESCRIPTION_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_ARRAY_DESCRIPTION_H

#include <string>

#include "light_field_depth/ros/array_check.h"

namespace light_field_depth
{
/// What a file for depth.launch says of an array and of its input.
struct ArrayDescription
{
  ViewArray array;
  ArrayCheckOptions options;
};

/// @throw InputError that names the file
ArrayDescription readArrayDescription(const std::string& file);

/// The array as a file for depth.launch. @param sync_tolerance_s left out if 0
std::string arrayDescriptionText(const ArrayDescription& description, double sync_tolerance_s);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_ARRAY_DESCRIPTION_H
