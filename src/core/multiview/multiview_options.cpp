#include <string>
#include <tuple>
#include <vector>

#include "light_field_depth/core/enum_names.h"
#include "light_field_depth/core/multiview_options.h"

namespace light_field_depth
{
namespace
{
constexpr EnumNames<MultiviewPreset, 4> PRESET_NAMES = {{
    {MultiviewPreset::Quality, "quality"},
    {MultiviewPreset::Balanced, "balanced"},
    {MultiviewPreset::Realtime, "realtime"},
    {MultiviewPreset::Fast, "fast"},
}};

/// What a preset decides where the options leave it to it.
struct PresetNumbers
{
  float label_step_px = 0.125F;
  int visibility_passes = 1;
  int refinements = 2;
};

PresetNumbers numbersOf(MultiviewPreset preset)
{
  switch (preset)
  {
    case MultiviewPreset::Quality:
      return {0.0625F, 2, 3};
    case MultiviewPreset::Realtime:
    case MultiviewPreset::Fast:
      return {0.125F, 1, 1};
    case MultiviewPreset::Balanced:
      break;
  }
  return {};
}

template <typename Number>
Number chosenNumber(Number option, Number preset)
{
  return option == static_cast<Number>(MultiviewOptions::PRESET_NUMBER) ? preset : option;
}

}  // namespace

std::string toString(MultiviewPreset preset)
{
  return enumName(PRESET_NAMES, preset);
}

MultiviewPreset multiviewPresetFromString(const std::string& name)
{
  return enumValue(PRESET_NAMES, name, "preset");
}

bool operator==(const MultiviewOptions& left, const MultiviewOptions& right)
{
  const auto fields = [](const MultiviewOptions& options)
  {
    return std::tie(options.preset, options.label_step_px, options.small_change_penalty,
                    options.large_change_penalty, options.visibility_passes, options.background_fusion,
                    options.thin_structures, options.boundary_pixels, options.refinements,
                    options.brightness_slope, options.refinement_smoothness, options.registration,
                    options.temporal);
  };
  return fields(left) == fields(right);
}

MultiviewOptions withPresetNumbers(MultiviewOptions options)
{
  const PresetNumbers preset = numbersOf(options.preset);
  options.label_step_px = chosenNumber(options.label_step_px, preset.label_step_px);
  options.visibility_passes = chosenNumber(options.visibility_passes, preset.visibility_passes);
  options.refinements = chosenNumber(options.refinements, preset.refinements);
  return options;
}

std::vector<std::string> validate(const MultiviewOptions& given)
{
  const MultiviewOptions options = withPresetNumbers(given);
  std::vector<std::string> problems;
  const auto require = [&](bool good, const std::string& field, double value, const std::string& limits)
  {
    if (!good)
    {
      problems.push_back("multiview." + field + " is " + std::to_string(value) + "; it must be " + limits +
                         ".");
    }
  };
  require(options.label_step_px >= 0.03125F && options.label_step_px <= 1.0F, "label_step_px",
          options.label_step_px, "between 1/32 and 1 px, or -1 for the preset's number");
  require(options.small_change_penalty >= 1 && options.small_change_penalty <= 1000, "small_change_penalty",
          options.small_change_penalty, "between 1 and 1000");
  require(options.large_change_penalty >= 1 && options.large_change_penalty <= 10000, "large_change_penalty",
          options.large_change_penalty, "between 1 and 10000");
  require(options.visibility_passes >= 0 && options.visibility_passes <= 5, "visibility_passes",
          options.visibility_passes, "between 0 and 5, or -1 for the preset's number");
  require(options.refinements >= 0 && options.refinements <= 10, "refinements", options.refinements,
          "between 0 and 10, or -1 for the preset's number");
  require(options.refinement_smoothness > 0.0F && options.refinement_smoothness <= 1e6F,
          "refinement_smoothness", options.refinement_smoothness, "positive and at most 1000000");
  return problems;
}

}  // namespace light_field_depth
