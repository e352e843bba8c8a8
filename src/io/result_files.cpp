#include "light_field_depth/io/result_files.h"

#include <array>
#include <cstdio>

#include "light_field_depth/io/disparity_image.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/io/image_files.h"
#include "light_field_depth/io/pfm.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* VIEW_MAPS = "view_maps";

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

std::string denseCloudName(const ResultFileOptions& options)
{
  return "dense_cloud." + toString(options.cloud_format);
}

void writeViewMap(const fs::path& results, const GridPosition& view, const ViewMap& map)
{
  const fs::path folder = results / VIEW_MAPS;
  makeFolder(folder);
  std::array<char, 32> place{};
  std::snprintf(place.data(), place.size(), "_%02d_%02d", view.row, view.column);
  const std::string suffix = place.data();
  writePfm(folder / ("disparity" + suffix + ".pfm"), map.disparity);
  writePfm(folder / ("confidence" + suffix + ".pfm"), map.confidence);
  constexpr double FULL = 127.5;  // times 2 is white
  cv::Mat shown;
  map.origin.convertTo(shown, CV_8U, FULL);
  writeImage(folder / ("origin" + suffix + ".png"), shown);
}

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
  if (writePly(folder / "cloud.ply", result.organized_cloud, options.axes) > 0)
  {
    report.files.emplace_back("cloud.ply");
  }
  if (!result.dense_cloud.empty())
  {
    CloudWriter writer(folder / denseCloudName(options), options.cloud_format, options.axes);
    writer.write(result.dense_cloud.data(), result.dense_cloud.size());
    writer.finish();
  }
  for (const std::string& name : {denseCloudName(options), std::string(VIEW_MAPS)})
  {
    if (fs::exists(folder / name))
    {
      report.files.push_back(name);
    }
  }
  report.files.emplace_back("report.json");
}

}  // namespace light_field_depth
