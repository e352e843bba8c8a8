#ifndef LIGHT_FIELD_DEPTH_IO_RESULT_FILES_H
#define LIGHT_FIELD_DEPTH_IO_RESULT_FILES_H

#include <filesystem>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/io/cloud_files.h"
#include "light_field_depth/io/map_files.h"
#include "light_field_depth/io/report.h"

namespace light_field_depth
{
/// Which files are written of a result.
struct ResultFileOptions
{
  std::vector<MapFormat> formats = {MapFormat::Pfm};  ///< of disparity, confidence and depth
  CloudAxes axes = CloudAxes::Optical;                ///< of the clouds that are written
  bool preview = false;  ///< preview.png: reference view, disparity and confidence beside each other
};

/// Writes disparity, confidence and, where the result has them, depth (in every format), disparity.png,
/// cloud.ply and dense_cloud.ply, and lists them in the report together with report.json, which the caller
/// writes last.
/// @param folder exists
/// @param reference image of the reference view; needed for the preview alone
/// @throw InputError if a file cannot be written
void writeResultFiles(const std::filesystem::path& folder, const PipelineResult& result,
                      const cv::Mat& reference, const ResultFileOptions& options, RunReport& report);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_RESULT_FILES_H
