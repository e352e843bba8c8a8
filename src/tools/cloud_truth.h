#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_CLOUD_TRUTH_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_CLOUD_TRUTH_H

#include <filesystem>

#include "light_field_depth/evaluation/cloud_score.h"

namespace light_field_depth
{
/// The true surfaces of a calibrated light field in a folder: the truth of its reference view, and of every
/// view that has a file view_truths/truth_ROW_COLUMN.pfm, or .png with 16 bits whose values are 8192
/// (disparity + 4).
/// @throw InputError
CloudTruth readCloudTruth(const std::filesystem::path& folder);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_CLOUD_TRUTH_H
