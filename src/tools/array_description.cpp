#include "tools/array_description.h"

#include <sstream>

#include <yaml-cpp/yaml.h>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/ros/yaml_parameter.h"

namespace light_field_depth
{
namespace
{
template <class Value>
void read(const YAML::Node& top, const std::string& field, Value& value)
{
  if (top[field])
  {
    value = top[field].as<Value>();
  }
}

void appendField(const std::string& name, const std::string& value, std::ostream& text)
{
  if (!value.empty())
  {
    text << ", " << name << ": '" << value << "'";
  }
}

}  // namespace

ArrayDescription readArrayDescription(const std::string& file)
{
  ArrayDescription description;
  try
  {
    const std::string text = readFile(file);
    const YAML::Node top = YAML::Load(text);
    if (!top.IsMap() || !top["array"])
    {
      throw InputError("'" + file + "' has no 'array'; give a file as those in config/arrays are.");
    }
    description.array = viewArrayFromParameter(parameterFromYaml(text)["array"]);
    ArrayCheckOptions& options = description.options;
    read(top, "sync_tolerance", options.sync_tolerance_s);
    read(top, "use_camera_info", options.use_camera_info);
    read(top, "rectify", options.rectify);
    read(top, "mask_black", options.mask_black);
    read(top, "decimation", options.decimation);
    read(top, "baseline_x", options.calibration.baseline_x_m);
    read(top, "baseline_y", options.calibration.baseline_y_m);
    read(top, "focal_length", options.calibration.focal_length_px);
    read(top, "disparity_offset", options.calibration.disparity_offset_px);
  }
  catch (const YAML::Exception& error)
  {
    throw InputError("'" + file + "' cannot be read as YAML: " + error.what() + "; correct it.");
  }
  return description;
}

std::string arrayDescriptionText(const ArrayDescription& description, double sync_tolerance_s)
{
  std::ostringstream text;
  text << "# Written by check_array.\n";
  if (sync_tolerance_s > 0.0)
  {
    text << "sync_tolerance: " << sync_tolerance_s << "\n";
  }
  const ArrayCheckOptions& options = description.options;
  text << "use_camera_info: " << std::boolalpha << options.use_camera_info << "\n"
       << "rectify: " << options.rectify << "\nmask_black: " << options.mask_black
       << "\ndecimation: " << options.decimation << "\n";
  if (options.calibration.hasBaseline())
  {
    text << "baseline_x: " << options.calibration.baseline_x_m
         << "\nbaseline_y: " << options.calibration.baseline_y_m << "\n";
  }
  if (options.calibration.focal_length_px > 0.0)
  {
    text << "focal_length: " << options.calibration.focal_length_px
         << "\ndisparity_offset: " << options.calibration.disparity_offset_px << "\n";
  }
  const GridPosition& reference = description.array.views[description.array.reference].grid;
  text << "array:\n  reference: [" << reference.row << ", " << reference.column << "]\n  views:\n";
  for (const ViewTopics& view : description.array.views)
  {
    text << "    - {row: " << view.grid.row << ", column: " << view.grid.column << ", image: '" << view.image
         << "'";
    appendField("camera_info", view.camera_info, text);
    appendField("camera_info_url", view.camera_info_url, text);
    appendField("mask", view.mask, text);
    appendField("mask_file", view.mask_file, text);
    text << "}\n";
  }
  return text.str();
}

}  // namespace light_field_depth
