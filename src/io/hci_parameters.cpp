#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>

#include <boost/property_tree/ini_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include "io/folder_description.h"
#include "io/number_text.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
constexpr double MM_PER_M = 1000.0;  // the file has millimetres
constexpr int MAX_GRID_SIDE = 255;   // far more than any camera has
constexpr std::string_view BYTE_ORDER_MARK = "\xEF\xBB\xBF";

/// Typed access to the fields of a parameters.cfg.
class Parameters
{
public:
  explicit Parameters(std::filesystem::path file) : file_(std::move(file))
  {
    try
    {
      std::string text = readFile(file_);
      if (text.compare(0, BYTE_ORDER_MARK.size(), BYTE_ORDER_MARK) == 0)
      {
        text.erase(0, BYTE_ORDER_MARK.size());
      }
      std::istringstream stream(text);
      boost::property_tree::read_ini(stream, tree_);
    }
    catch (const boost::property_tree::ini_parser_error& error)
    {
      throw InputError("'" + file_.string() + "' cannot be read as a parameters.cfg: " + error.message() +
                       " in line " + std::to_string(error.line()) + ".");
    }
  }

  std::optional<double> number(const std::string& field) const
  {
    const auto text = tree_.get_optional<std::string>(field);
    if (!text)
    {
      return std::nullopt;
    }
    const auto value = numberFromText<double>(*text);
    if (!value || !std::isfinite(*value))
    {
      fail(field, *text, "a number");
    }
    return value;
  }

  std::optional<double> positive(const std::string& field) const
  {
    const std::optional<double> value = number(field);
    if (value && *value <= 0.0)
    {
      fail(field, std::to_string(*value), "a positive number");
    }
    return value;
  }

  int count(const std::string& field, int default_value) const
  {
    const std::optional<double> value = number(field);
    if (!value)
    {
      return default_value;
    }
    if (*value != std::floor(*value) || *value < 1 || *value > MAX_GRID_SIDE)
    {
      fail(field, std::to_string(*value), "a whole number from 1 to " + std::to_string(MAX_GRID_SIDE));
    }
    return static_cast<int>(*value);
  }

private:
  [[noreturn]] void fail(const std::string& field, const std::string& value, const std::string& wanted) const
  {
    throw InputError("In '" + file_.string() + "', " + field + " is '" + value + "'; it must be " + wanted +
                     ".");
  }

  std::filesystem::path file_;
  boost::property_tree::ptree tree_;
};

std::optional<CameraDescription> camera(const Parameters& parameters)
{
  const auto focal_length_mm = parameters.positive("intrinsics.focal_length_mm");
  const auto sensor_size_mm = parameters.positive("intrinsics.sensor_size_mm");
  const auto baseline_mm = parameters.positive("extrinsics.baseline_mm");
  const auto focus_distance_m = parameters.positive("extrinsics.focus_distance_m");
  if (!focal_length_mm || !sensor_size_mm || !baseline_mm || !focus_distance_m)
  {
    return std::nullopt;
  }
  CameraDescription camera;
  camera.focal_length_per_side = *focal_length_mm / *sensor_size_mm;
  camera.baseline_m = *baseline_mm / MM_PER_M;
  camera.focus_distance_m = focus_distance_m;
  return camera;
}

}  // namespace

void readHciParameters(const std::filesystem::path& cfg_file, FolderDescription& description)
{
  const Parameters parameters(cfg_file);
  const cv::Rect grid = description.grid.value_or(cv::Rect());
  description.grid = cv::Rect(0, 0, parameters.count("extrinsics.num_cams_x", grid.width),
                              parameters.count("extrinsics.num_cams_y", grid.height));
  description.camera = camera(parameters);
  const auto disparity_min = parameters.number("meta.disp_min");
  const auto disparity_max = parameters.number("meta.disp_max");
  if (disparity_min && disparity_max && *disparity_min < *disparity_max)
  {
    description.disparity_range =
        DisparityRange{static_cast<float>(*disparity_min), static_cast<float>(*disparity_max)};
  }
}

}  // namespace light_field_depth
