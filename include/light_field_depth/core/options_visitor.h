#ifndef LIGHT_FIELD_DEPTH_CORE_OPTIONS_VISITOR_H
#define LIGHT_FIELD_DEPTH_CORE_OPTIONS_VISITOR_H

#include <string>
#include <type_traits>

#include "light_field_depth/core/pipeline.h"

namespace light_field_depth
{
/// Calls visit(name, field) for every setting of a run: the one list of the names by which the command line,
/// files, reports and parameter servers know the settings. A new setting is one more line here.
///
/// Fields are bool, int, float, double, std::string, or an enumeration that has toString(value) and, below,
/// fromString(text, value). PipelineOptions::disparity_range is not in the list, since it may be absent.
/// @param options PipelineOptions, const or not
template <class Options, class Visitor>
void visitOptions(Options& options, Visitor&& visit)
{
  static_assert(std::is_same_v<std::remove_const_t<Options>, PipelineOptions>);
  visit("method", options.method);
  visit("views", options.views);
  visit("min_confidence", options.min_confidence);
  visit("dense_cloud_min_confidence", options.dense_cloud.min_confidence);
  visit("dense_cloud_voxel_size_m", options.dense_cloud.voxel_size_m);
  visit("multiview_preset", options.multiview.preset);
  visit("multiview_label_step_px", options.multiview.label_step_px);
  visit("multiview_small_change_penalty", options.multiview.small_change_penalty);
  visit("multiview_large_change_penalty", options.multiview.large_change_penalty);
  visit("multiview_visibility_passes", options.multiview.visibility_passes);
  visit("multiview_edge_sides", options.multiview.edge_sides);
  visit("multiview_refinements", options.multiview.refinements);
  visit("multiview_brightness_slope", options.multiview.brightness_slope);
  visit("multiview_refinement_smoothness", options.multiview.refinement_smoothness);
}

/// @throw InputError that lists the names
inline void fromString(const std::string& name, Method& value)
{
  value = methodFromString(name);
}

/// @throw InputError that lists the names
inline void fromString(const std::string& name, MultiviewPreset& value)
{
  value = multiviewPresetFromString(name);
}

/// @throw InputError that lists the names
inline void fromString(const std::string& name, ViewSelection& value)
{
  value = viewSelectionFromString(name);
}

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_OPTIONS_VISITOR_H
