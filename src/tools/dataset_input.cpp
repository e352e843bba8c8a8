#include "tools/dataset_input.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/dataset.h"
#include "light_field_depth/ros/view_array.h"
#include "tools/number_checks.h"

namespace light_field_depth
{
namespace
{
// A made-up calibration: a field of view of 53 degrees, and the plane of disparity 0 at 2 m. The offset keeps
// the negative disparities of focused light fields in front of the camera.
constexpr double NOMINAL_FOCUS_DEPTH_M = 2.0;
constexpr double NOMINAL_DISPARITY_OFFSET_PX = 4.0;
constexpr double NOMINAL_OFFSET_PER_NEAREST = 1.5;

Calibration nominalCalibration(const Dataset& dataset)
{
  const cv::Size size = dataset.light_field.size();
  Calibration calibration;
  calibration.focal_length_px = size.width;
  calibration.principal_point_px = {0.5 * (size.width - 1), 0.5 * (size.height - 1)};
  calibration.disparity_offset_px = NOMINAL_DISPARITY_OFFSET_PX;
  if (dataset.disparity_range)
  {
    calibration.disparity_offset_px =
        std::max(NOMINAL_DISPARITY_OFFSET_PX, -NOMINAL_OFFSET_PER_NEAREST * dataset.disparity_range->min);
  }
  calibration.baseline_m =
      NOMINAL_FOCUS_DEPTH_M * calibration.disparity_offset_px / calibration.focal_length_px;
  return calibration;
}

Calibration givenCalibration(const DatasetInputOptions& options, const cv::Size& size)
{
  if (!options.baseline_m || !options.focal_length_px)
  {
    throw InputError("Only one of --baseline and --focal-length is given; give both, or neither.");
  }
  Calibration calibration;
  calibration.baseline_m = *options.baseline_m;
  calibration.focal_length_px = *options.focal_length_px;
  calibration.principal_point_px = {0.5 * (size.width - 1), 0.5 * (size.height - 1)};
  calibration.disparity_offset_px = options.disparity_offset_px;
  return calibration;
}

std::string sharedTopicText(const std::string& setting, const GridPosition& one, const GridPosition& other,
                            const std::string& topic)
{
  return setting + " gives the views " + toString(one) + " and " + toString(other) + " one topic, " + topic +
         "; put {row} and {column} into it.";
}

/// Nobody could tell the views apart.
void checkTopics(const LightField& light_field, const std::string& option, const std::string& pattern)
{
  const std::string setting = option + " '" + pattern + "'";
  std::map<std::string, GridPosition> views;
  for (const View& view : light_field.views)
  {
    const auto [other, is_new] = views.try_emplace(topicFromPattern(pattern, view.grid), view.grid);
    if (!is_new)
    {
      throw InputError(sharedTopicText(setting, other->second, view.grid, other->first));
    }
  }
}

GridPosition referenceFrom(const std::string& text)
{
  std::istringstream stream(text);
  GridPosition position;
  char comma = 0;
  stream >> position.row >> comma >> position.column;
  if (!stream || comma != ',' || !stream.eof())
  {
    throw InputError("--reference is '" + text + "'; give a row and a column, as in 4,4.");
  }
  return position;
}

/// Datasets number rows and columns from 0 or from 1; topics begin with 0, as the arrays in config do.
void numberFromZero(LightField& light_field)
{
  GridPosition first = light_field.views.front().grid;
  for (const View& view : light_field.views)
  {
    first.row = std::min(first.row, view.grid.row);
    first.column = std::min(first.column, view.grid.column);
  }
  for (View& view : light_field.views)
  {
    view.grid.row -= first.row;
    view.grid.column -= first.column;
  }
}

std::string nominalWarning(const std::string& folder, const Calibration& calibration)
{
  std::ostringstream text;
  text << folder << " has no calibration: a nominal one is published (focal length "
       << calibration.focal_length_px << " px, baseline " << calibration.baseline_m << " m, disparity offset "
       << calibration.disparity_offset_px
       << " px), so depth is right in order only, not in metres. Give --baseline and --focal-length for "
          "metres.";
  return text.str();
}

}  // namespace

void addDatasetInputOptions(CLI::App& app, DatasetInputOptions& options)
{
  app.add_option("--input", options.folder, "Folder of the light field")->required();
  app.add_option("--views", options.views, "Views to publish: all, row, column, cross or star")
      ->capture_default_str();
  app.add_option("--order", options.order, "auto, row-major or column-major: which number is the row")
      ->capture_default_str();
  app.add_option("--flip", options.flip, "Turn the order of none, rows, columns or both round, or auto")
      ->capture_default_str();
  app.add_option("--grid", options.grid, "ROWSxCOLUMNS of views that are named by one number");
  app.add_option("--tiles", options.tiles, "ROWSxCOLUMNS of the views in one image");
  app.add_option("--frame", options.frame, "Number or folder of the frame of a sequence (the first)");
  app.add_option("--reference", options.reference,
                 "ROW,COL of the reference view (the middle one by default)");
  app.add_option("--rate", options.rate_hz, "Frames a second")
      ->check(CLI::Range(1e-3, 1e4))
      ->check(FINITE)
      ->capture_default_str();
  app.add_option("--frame-id", options.frame_id,
                 "Frame of the images; {row} and {column} in it give each view one of its own")
      ->capture_default_str();
  app.add_option("--image-topic", options.topics.image, "Pattern of the image topics")->capture_default_str();
  app.add_option("--camera-info-topic", options.topics.camera_info, "Pattern of the CameraInfo topics")
      ->capture_default_str();
  app.add_option("--baseline", options.baseline_m, "Metres between adjacent views, for a dataset without it")
      ->check(POSITIVE);
  app.add_option("--focal-length", options.focal_length_px, "Pixels, for a dataset without it")
      ->check(POSITIVE);
  app.add_option("--disparity-offset", options.disparity_offset_px,
                 "Change of the principal point from a view to the next, pixels; with --baseline")
      ->check(FINITE)
      ->capture_default_str();
}

CalibratedDataset readCalibratedDataset(const DatasetInputOptions& options)
{
  DatasetOptions dataset_options;
  dataset_options.order = orderOption(options.order);
  dataset_options.flip = flipOption(options.flip);
  if (!options.grid.empty())
  {
    dataset_options.grid = gridFromString("--grid", options.grid);
  }
  if (!options.tiles.empty())
  {
    dataset_options.tiles = gridFromString("--tiles", options.tiles);
  }
  if (!options.frame.empty())
  {
    dataset_options.frame = options.frame;
  }
  if (!options.reference.empty())
  {
    dataset_options.reference = referenceFrom(options.reference);
  }
  Dataset dataset = readDataset(options.folder, dataset_options);
  numberFromZero(dataset.light_field);
  CalibratedDataset result;
  result.light_field = selectViews(dataset.light_field, viewSelectionFromString(options.views));
  checkTopics(result.light_field, "--image-topic", options.topics.image);
  checkTopics(result.light_field, "--camera-info-topic", options.topics.camera_info);
  if (options.baseline_m || options.focal_length_px)
  {
    result.light_field.calibration = givenCalibration(options, result.light_field.size());
  }
  if (!result.light_field.calibration)
  {
    result.light_field.calibration = nominalCalibration(dataset);
    result.warning = nominalWarning(options.folder, *result.light_field.calibration);
  }
  return result;
}

}  // namespace light_field_depth
