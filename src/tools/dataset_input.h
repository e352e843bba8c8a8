#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_DATASET_INPUT_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_DATASET_INPUT_H

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/ros/view_messages.h"

namespace light_field_depth
{
/// What light_field_player and dataset_to_bag have in common: which light field, and as which topics.
struct DatasetInputOptions
{
  std::string folder;
  std::string views = "all";
  std::string order = "auto";
  std::string flip = "auto";
  std::string grid;       ///< "ROWSxCOLUMNS"; empty: found
  std::string tiles;      ///< the same, of the views in one image
  std::string frame;      ///< of a sequence; empty: the first
  std::string reference;  ///< "ROW,COL"; empty: the middle view
  double rate_hz = 1.0;
  std::string frame_id = "light_field_optical_frame";
  TopicPatterns topics;

  // In place of the dataset's own calibration.
  std::optional<double> baseline_m;
  std::optional<double> focal_length_px;
  double disparity_offset_px = 0.0;
};

/// Adds the options of DatasetInputOptions to a command line.
void addDatasetInputOptions(CLI::App& app, DatasetInputOptions& options);

/// A light field that can be published: it always has a calibration.
struct CalibratedDataset
{
  LightField light_field;
  std::string warning;  ///< a sentence when the calibration is made up; empty otherwise
};

/// @throw InputError
CalibratedDataset readCalibratedDataset(const DatasetInputOptions& options);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_DATASET_INPUT_H
