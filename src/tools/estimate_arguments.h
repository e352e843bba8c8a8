#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_ARGUMENTS_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_ARGUMENTS_H

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "light_field_depth/core/input_limits.h"
#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/io/dataset.h"
#include "tools/estimate_output.h"

namespace light_field_depth
{
/// The command line as it was typed.
struct EstimateArguments
{
  std::string input;
  std::string output;
  std::string method;
  std::string preset;
  std::string temporal;
  std::string views;
  std::vector<int> reference;
  std::vector<float> disparity_range;
  bool stated_range = false;
  std::string order;
  std::string flip;
  std::string grid;
  std::string tiles;
  std::string frame;
  std::string frames;
  bool mask_black = false;
  bool dense = false;
  bool view_maps = false;
  int threads = 0;
  InputLimits limits;
  double max_memory_mb = 0.0;
  bool save_intermediate = false;
  OutputArguments output_files;
  std::vector<double> baseline_m;
  std::vector<double> principal_point_px;
  CameraOptions camera;
  bool strict = false;
  std::string config;
  std::vector<std::string> settings;
};

void declare(CLI::App& app, EstimateArguments& arguments);

/// Later ones win: the defaults, the file, --set, the options with a name of their own.
/// @throw InputError
PipelineOptions makeOptions(const EstimateArguments& arguments);

/// @throw InputError
DatasetOptions makeDatasetOptions(const EstimateArguments& arguments);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_ARGUMENTS_H
