#ifndef LIGHT_FIELD_DEPTH_IO_RESULT_FILES_H
#define LIGHT_FIELD_DEPTH_IO_RESULT_FILES_H

#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/core/view_maps.h"
#include "light_field_depth/io/cloud_files.h"
#include "light_field_depth/io/cloud_writer.h"
#include "light_field_depth/io/map_files.h"
#include "light_field_depth/io/report.h"

namespace light_field_depth
{
/// Which files are written of a result.
struct ResultFileOptions
{
  std::vector<MapFormat> formats = {MapFormat::Pfm};  ///< of disparity, confidence and depth
  CloudFormat cloud_format = CloudFormat::Ply;        ///< of the dense cloud
  CloudAxes axes = CloudAxes::Optical;                ///< of the clouds that are written
  bool preview = false;  ///< preview.png: reference view, disparity and confidence beside each other
};

/// The name of the file of the dense cloud: dense_cloud.ply, dense_cloud.pcd.
std::string denseCloudName(const ResultFileOptions& options);

/// Writes disparity_ROW_COLUMN.pfm, confidence_ROW_COLUMN.pfm and origin_ROW_COLUMN.png into the folder
/// view_maps, which is made. In origin 255 is seen by the reference view, 128 solved in others, 0 filled.
/// @param results the folder that view_maps lies in
/// @throw InputError if a file cannot be written
void writeViewMap(const std::filesystem::path& results, const GridPosition& view, const ViewMap& map);

/// Writes disparity, confidence and, where the result has them, depth (in every format), disparity.png,
/// cloud.ply and the dense cloud, and lists them in the report together with report.json, which the caller
/// writes last. A dense cloud and maps of views that are in the folder already, written while they were made,
/// are listed as well.
/// @param folder exists
/// @param reference image of the reference view; needed for the preview alone
/// @throw InputError if a file cannot be written
void writeResultFiles(const std::filesystem::path& folder, const PipelineResult& result,
                      const cv::Mat& reference, const ResultFileOptions& options, RunReport& report);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_RESULT_FILES_H
