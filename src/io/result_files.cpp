#include "light_field_depth/io/result_files.h"

#include "light_field_depth/io/disparity_image.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

void writeMaps(const fs::path& folder, const PipelineResult& result, const ResultFileOptions& options,
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

void writeResultFiles(const fs::path& folder, const PipelineResult& result, const cv::Mat& reference,
                      const ResultFileOptions& options, RunReport& report)
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
