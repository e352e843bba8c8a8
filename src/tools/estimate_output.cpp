#include "tools/estimate_output.h"

#include <algorithm>

#include "light_field_depth/io/disparity_image.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

void writeMaps(const fs::path& folder, const PipelineResult& result, const OutputOptions& options,
               RunReport& report)
{
  const Png16Scale disparity_scale = disparityPng16Scale(result.estimate.disparity);
  for (const MapFormat format : options.formats)
  {
    const auto write = [&](const char* name, const cv::Mat& map, const Png16Scale& scale)
    {
      if (!map.empty())
      {
        report.files.push_back(writeMap(folder / name, map, format, scale));
      }
    };
    write("disparity", result.estimate.disparity, disparity_scale);
    write("confidence", result.estimate.confidence, confidencePng16Scale());
    write("depth", result.depth, depthPng16Scale());
    if (format == MapFormat::Png16)
    {
      report.disparity_png16 = disparity_scale;
    }
  }
}

}  // namespace

void declareOutput(CLI::App& app, OutputArguments& arguments)
{
  app.add_option("--format", arguments.formats,
                 "pfm, npy, exr, png16 (16-bit PNG; scales in report.json), or a list of these with commas")
      ->capture_default_str();
  app.add_flag("--y-up", arguments.y_up, "clouds with y upwards and z towards the viewer");
  app.add_flag("--preview", arguments.preview,
               "also write preview.png: reference view, disparity and confidence beside each other");
}

OutputOptions outputOptions(const OutputArguments& arguments)
{
  OutputOptions options;
  options.formats = mapFormatsFromString(arguments.formats);
  options.axes = arguments.y_up ? CloudAxes::YUp : CloudAxes::Optical;
  options.preview = arguments.preview;
  return options;
}

void writeResults(const fs::path& folder, const PipelineResult& result, const cv::Mat& reference,
                  const OutputOptions& options, RunReport& report)
{
  report.files.clear();
  writeMaps(folder, result, options, report);
  const cv::Mat& disparity = result.estimate.disparity;
  writeImage(folder / "disparity.png", disparityWithScale(disparity, shownRange(disparity)));
  report.files.emplace_back("disparity.png");
  if (options.preview)
  {
    writeImage(folder / "preview.png", previewImage(reference, disparity, result.estimate.confidence));
    report.files.emplace_back("preview.png");
  }
  const auto write_cloud = [&](const char* name, const std::vector<ColoredPoint>& points)
  {
    if (writePly(folder / name, points, options.axes) > 0)
    {
      report.files.emplace_back(name);
    }
  };
  write_cloud("cloud.ply", result.organized_cloud);
  write_cloud("dense_cloud.ply", result.dense_cloud);
  report.files.emplace_back("report.json");
}

}  // namespace light_field_depth
