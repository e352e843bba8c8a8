#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_OUTPUT_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_OUTPUT_H

#include <string>

#include <CLI/CLI.hpp>

#include "light_field_depth/io/result_files.h"

namespace light_field_depth
{
/// Which files estimate writes, as they were typed.
struct OutputArguments
{
  std::string formats = "pfm";
  std::string cloud_format = "ply";
  bool y_up = false;
  bool preview = false;
};

void declareOutput(CLI::App& app, OutputArguments& arguments);

/// @throw InputError
ResultFileOptions resultFileOptions(const OutputArguments& arguments);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_ESTIMATE_OUTPUT_H
