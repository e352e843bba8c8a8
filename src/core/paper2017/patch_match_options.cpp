#include <string>
#include <vector>

#include "core/paper2017/patch_match.h"

namespace light_field_depth
{
std::vector<std::string> validate(const PatchMatchOptions& options)
{
  std::vector<std::string> problems;
  const auto require = [&](bool usable, const std::string& sentence)
  {
    if (!usable)
    {
      problems.push_back(sentence);
    }
  };
  require(options.levels >= 1 && options.levels <= 12,
          "cpm_levels is " + std::to_string(options.levels) + "; it must be between 1 and 12.");
  require(
      options.pyramid_ratio >= 0.3 && options.pyramid_ratio <= 0.9,
      "cpm_pyramid_ratio is " + std::to_string(options.pyramid_ratio) + "; it must be between 0.3 and 0.9.");
  require(options.grid_spacing_px >= 1 && options.grid_spacing_px <= 16,
          "cpm_grid_spacing_px is " + std::to_string(options.grid_spacing_px) +
              "; it must be between 1 and 16 pixels.");
  require(options.iterations >= 1 && options.iterations <= 100,
          "cpm_iterations is " + std::to_string(options.iterations) + "; it must be between 1 and 100.");
  require(options.search_radius_px >= 1 && options.search_radius_px <= 64,
          "cpm_search_radius_px is " + std::to_string(options.search_radius_px) +
              "; it must be between 1 and 64 pixels.");
  require(options.max_displacement_px >= 1.0 && options.max_displacement_px <= 1000.0,
          "cpm_max_displacement_px is " + std::to_string(options.max_displacement_px) +
              "; it must be between 1 and 1000 pixels.");
  require(options.consistency_threshold_px > 0.0 && options.consistency_threshold_px <= 100.0,
          "cpm_consistency_threshold_px is " + std::to_string(options.consistency_threshold_px) +
              "; it must be above 0 and at most 100 pixels.");
  require(options.confidence_sigma_px >= 0.01 && options.confidence_sigma_px <= 100.0,
          "cpm_confidence_sigma_px is " + std::to_string(options.confidence_sigma_px) +
              "; it must be between 0.01 and 100 pixels.");
  require(options.min_region_seeds >= 0 && options.min_region_seeds <= 100000,
          "cpm_min_region_seeds is " + std::to_string(options.min_region_seeds) +
              "; it must be between 0 and 100000 seeds.");
  require(options.border_px >= 0 && options.border_px <= 64,
          "cpm_border_px is " + std::to_string(options.border_px) + "; it must be between 0 and 64 pixels.");
  return problems;
}

}  // namespace light_field_depth
