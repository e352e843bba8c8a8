#ifndef LIGHT_FIELD_DEPTH_IO_PIPELINE_OPTIONS_IO_H
#define LIGHT_FIELD_DEPTH_IO_PIPELINE_OPTIONS_IO_H

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "light_field_depth/core/pipeline.h"

namespace light_field_depth
{
/// Numbers of single precision are given as the shortest decimal that stands for them, enumerations by name,
/// lists as "3,4,5".
using OptionValue = std::variant<bool, int, double, std::string>;

/// A setting by the name that visitOptions() gives it.
struct NamedOption
{
  std::string name;   ///< as for `--set`
  OptionValue value;  ///< in effect
};

/// All settings of visitOptions(), in its order.
std::vector<NamedOption> listOptions(const PipelineOptions& options);

/// "true", "3", "0.1", "cross".
std::string toString(const OptionValue& value);

/// Sets one setting from text. @throw InputError if there is no such setting or the text does not fit it
void setOption(PipelineOptions& options, const std::string& name, const std::string& text);

/// The same from one text "NAME=VALUE". @throw InputError, also if there is no '='
void setOption(PipelineOptions& options, const std::string& assignment);

/// Sets all settings of a YAML file of `name: value` pairs; besides the names of visitOptions(),
/// `disparity_range: [min, max]` is known. @throw InputError that names the file and the field
void readOptionsFile(const std::filesystem::path& path, PipelineOptions& options);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_PIPELINE_OPTIONS_IO_H
