#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_OUTPUT_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_OUTPUT_H

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/io/cloud_files.h"
#include "light_field_depth/io/map_files.h"
#include "light_field_depth/io/report.h"

namespace light_field_depth
{
/// Which files estimate writes, as they were typed.
struct OutputArguments
{
  std::string formats = "pfm";
  bool y_up = false;
  bool preview = false;
};

void declareOutput(CLI::App& app, OutputArguments& arguments);

/// The same, understood.
struct OutputOptions
{
  std::vector<MapFormat> formats = {MapFormat::Pfm};
  CloudAxes axes = CloudAxes::Optical;
  bool preview = false;
};

/// @throw InputError
OutputOptions outputOptions(const OutputArguments& arguments);

/// Writes all maps, pictures and clouds of a result and lists them in the report, which itself comes last.
/// @throw InputError if a file cannot be written
void writeResults(const std::filesystem::path& folder, const PipelineResult& result, const cv::Mat& reference,
                  const OutputOptions& options, RunReport& report);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_OUTPUT_H
