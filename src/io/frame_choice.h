#ifndef LIGHT_FIELD_DEPTH_SRC_IO_FRAME_CHOICE_H
#define LIGHT_FIELD_DEPTH_SRC_IO_FRAME_CHOICE_H

#include <optional>
#include <string>
#include <vector>

#include "io/folder_description.h"

namespace light_field_depth
{
/// Takes the names of the frames into the description, with a note if there is more than one.
/// @param wanted the name of a frame or its last number; the first frame if absent
/// @return the index of the frame @throw InputError if there is no such frame
std::size_t chooseFrame(const std::vector<std::string>& names, const std::optional<std::string>& wanted,
                        FolderDescription& description);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_FRAME_CHOICE_H
