#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_EXPECTED_STAGES_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_EXPECTED_STAGES_H

#include <vector>

#include "light_field_depth/core/multiview_options.h"
#include "light_field_depth/core/run_context.h"

namespace light_field_depth::multiview
{
/// The stages of a frame in their order, for the progress.
/// @param coarse_to_fine whether a search at half the resolution comes first
/// @param pair whether a search from the other view, at half the resolution, comes last
std::vector<ExpectedStage> expectedStages(const MultiviewOptions& options, bool coarse_to_fine, bool pair);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_EXPECTED_STAGES_H
