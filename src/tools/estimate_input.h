#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_INPUT_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_INPUT_H

#include <string>
#include <vector>

#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/io/dataset.h"
#include "light_field_depth/io/report.h"

namespace light_field_depth
{
/// A light field and how long it took to read it.
struct EstimateInput
{
  Dataset dataset;
  double decode_ms = 0.0;
};

/// Reads the views that the method needs, or all of them where they are to be seen in the dense cloud.
/// @throw InputError
EstimateInput readInput(const std::string& folder, DatasetOptions options, const PipelineOptions& settings,
                        bool all_views);

/// The names of the frames from --frames among all of a sequence.
/// @throw InputError
std::vector<std::string> wantedFrames(const std::string& text, const std::vector<std::string>& names);

/// Sets what the report says of the light field.
void describeInput(const std::string& input, const Dataset& dataset, RunReport& report);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_INPUT_H
