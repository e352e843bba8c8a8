#ifndef LIGHT_FIELD_DEPTH_CORE_OPTIONS_VISITOR_H
#define LIGHT_FIELD_DEPTH_CORE_OPTIONS_VISITOR_H

#include <string>
#include <type_traits>

#include "light_field_depth/core/pipeline.h"

namespace light_field_depth
{
/// The part of visitOptions() that the method of 2017 has for itself.
/// @param options Paper2017Options, const or not
template <class Options, class Visitor>
void visitPaper2017Options(Options& options, Visitor& visit)
{
  static_assert(std::is_same_v<std::remove_const_t<Options>, Paper2017Options>);
  visit("paper2017_parameters", options.parameters);
  visit("volume_rows", options.volumes.rows);
  visit("volume_columns", options.volumes.columns);
  visit("initializer", options.initializer);
  visit("match_directions", options.match_directions);
  auto& matching = options.patch_match;
  visit("cpm_levels", matching.levels);
  visit("cpm_pyramid_ratio", matching.pyramid_ratio);
  visit("cpm_grid_spacing_px", matching.grid_spacing_px);
  visit("cpm_iterations", matching.iterations);
  visit("cpm_search_radius_px", matching.search_radius_px);
  visit("cpm_max_displacement_px", matching.max_displacement_px);
  visit("cpm_subpixel", matching.subpixel);
  visit("cpm_consistency_threshold_px", matching.consistency_threshold_px);
  visit("cpm_confidence_sigma_px", matching.confidence_sigma_px);
  visit("cpm_weigh_by_centre", matching.weigh_by_centre);
  visit("cpm_min_region_seeds", matching.min_region_seeds);
  visit("cpm_border_px", matching.border_px);
  auto& filter = options.feature_flow;
  visit("feature_flow", filter.enabled);
  visit("filter_sigma_spatial_px", filter.sigma_spatial_px);
  visit("filter_sigma_range", filter.sigma_range);
  visit("filter_angular", filter.angular);
  visit("filter_sigma_angular_views", filter.sigma_angular_views);
  visit("filter_sigma_angular_range", filter.sigma_angular_range);
  visit("filter_iterations", filter.iterations);
  auto& variational = options.variational;
  visit("variational", variational.enabled);
  visit("variational_views", variational.views);
  visit("variational_smoothness", variational.smoothness);
  visit("variational_gradient_weight", variational.gradient_weight);
  visit("variational_edge_kappa", variational.edge_kappa);
  visit("variational_presmoothing_px", variational.presmoothing_px);
  visit("variational_warps", variational.warps);
  visit("variational_sor_iterations", variational.sor_iterations);
  visit("variational_sor_omega", variational.sor_omega);
}

/// The part of visitOptions() that the multi-view method has for itself.
/// @param options MultiviewOptions, const or not
template <class Options, class Visitor>
void visitMultiviewOptions(Options& options, Visitor& visit)
{
  static_assert(std::is_same_v<std::remove_const_t<Options>, MultiviewOptions>);
  visit("multiview_preset", options.preset);
  visit("multiview_label_step_px", options.label_step_px);
  visit("multiview_small_change_penalty", options.small_change_penalty);
  visit("multiview_large_change_penalty", options.large_change_penalty);
  visit("multiview_visibility_passes", options.visibility_passes);
  visit("multiview_background_fusion", options.background_fusion);
  visit("multiview_thin_structures", options.thin_structures);
  visit("multiview_boundary_pixels", options.boundary_pixels);
  visit("multiview_refinements", options.refinements);
  visit("multiview_brightness_slope", options.brightness_slope);
  visit("multiview_refinement_smoothness", options.refinement_smoothness);
  visit("multiview_registration", options.registration);
  visit("multiview_temporal", options.temporal);
}

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
  visit("keep_filled", options.keep_filled);
  visit("min_depth_m", options.min_depth_m);
  visit("max_depth_m", options.max_depth_m);
  visit("dense_maps", options.dense_cloud.maps);
  visit("dense_cloud_min_confidence", options.dense_cloud.min_confidence);
  visit("dense_cloud_voxel_size_m", options.dense_cloud.voxel_size_m);
  visit("dense_cloud_min_views", options.dense_cloud.min_views);
  visitPaper2017Options(options.paper2017, visit);
  visitMultiviewOptions(options.multiview, visit);
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

/// @throw InputError that lists the names
inline void fromString(const std::string& name, Paper2017Parameters& value)
{
  value = paper2017ParametersFromString(name);
}

/// @throw InputError that lists the names
inline void fromString(const std::string& name, FlowInitializer& value)
{
  value = flowInitializerFromString(name);
}

/// @throw InputError that lists the names
inline void fromString(const std::string& name, MatchDirections& value)
{
  value = matchDirectionsFromString(name);
}

/// @throw InputError that lists the names
inline void fromString(const std::string& name, RefinementViews& value)
{
  value = refinementViewsFromString(name);
}

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_OPTIONS_VISITOR_H
