#include "tools/estimate_output.h"

namespace light_field_depth
{
void declareOutput(CLI::App& app, OutputArguments& arguments)
{
  app.add_option("--format", arguments.formats,
                 "pfm, npy, exr, png16 (16-bit PNG; scales in report.json), or a list of these with commas")
      ->capture_default_str();
  app.add_option("--cloud-format", arguments.cloud_format, "of the dense cloud: ply or pcd, both binary")
      ->capture_default_str();
  app.add_flag("--y-up", arguments.y_up, "clouds with y upwards and z towards the viewer");
  app.add_flag("--preview", arguments.preview,
               "also write preview.png: reference view, disparity and confidence beside each other");
}

ResultFileOptions resultFileOptions(const OutputArguments& arguments)
{
  ResultFileOptions options;
  options.formats = mapFormatsFromString(arguments.formats);
  options.cloud_format = cloudFormatFromString(arguments.cloud_format);
  options.axes = arguments.y_up ? CloudAxes::YUp : CloudAxes::Optical;
  options.preview = arguments.preview;
  return options;
}

}  // namespace light_field_depth
