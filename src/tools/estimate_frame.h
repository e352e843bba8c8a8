#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_FRAME_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_FRAME_H

#include <cstddef>
#include <filesystem>

#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/io/report.h"
#include "tools/estimate_arguments.h"
#include "tools/estimate_input.h"

namespace light_field_depth
{
/// Where the results of one frame go, and which part of the whole work it is.
struct FrameWork
{
  std::filesystem::path output;
  std::size_t index = 0;
  std::size_t count = 1;
};

/// Solves one light field and writes its results.
/// @return whether the verdict has no warning
/// @throw InputError, Cancelled
bool estimateFrame(const EstimateArguments& arguments, const EstimateInput& input, const FrameWork& frame,
                   Pipeline& pipeline, RunReport report);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_FRAME_H
