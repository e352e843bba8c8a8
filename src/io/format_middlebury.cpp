// Stereo pairs with the calib.txt of the Middlebury benchmark of 2014, as ETH3D and others write it too.

#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "io/dataset_format.h"
#include "io/name_groups.h"
#include "io/number_text.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

constexpr double M_PER_MM = 1e-3;  // its baselines are in millimetres
constexpr const char* CALIBRATION = "calib.txt";
constexpr std::array<const char*, 2> TRUTHS = {"disp0GT.pfm", "disp0.pfm"};
/// ETH3D writes the image's width as the number of disparities: that says nothing.
constexpr double MAX_RANGE_OVER_WIDTH = 0.5;

using Fields = std::map<std::string, std::string>;

Fields readFields(const fs::path& file)
{
  Fields fields;
  std::istringstream lines(readFile(file));
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos)
    {
      const std::size_t begin = line.find_first_not_of(" \t\xEF\xBB\xBF");
      const std::size_t end = line.find_last_not_of(" \t", equals - (equals > 0 ? 1 : 0));
      fields[line.substr(begin, end + 1 - begin)] = line.substr(equals + 1);
    }
  }
  return fields;
}

class Calib
{
public:
  explicit Calib(const fs::path& file) : file_(file), fields_(readFields(file)) {}

  bool has(const std::string& field) const { return fields_.count(field) > 0; }

  std::optional<double> number(const std::string& field) const
  {
    if (!has(field))
    {
      return std::nullopt;
    }
    const auto value = numberFromText<double>(fields_.at(field));
    if (!value || !std::isfinite(*value))
    {
      fail(field, "a number");
    }
    return value;
  }

  /// The matrix of a camera, row by row. @throw InputError
  std::array<double, 9> matrix(const std::string& field) const
  {
    std::string text = fields_.at(field);
    for (char& letter : text)
    {
      letter = letter == '[' || letter == ']' || letter == ';' || letter == ',' ? ' ' : letter;
    }
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    std::array<double, 9> values{};
    for (double& value : values)
    {
      if (!(stream >> value) || !std::isfinite(value))
      {
        fail(field, "a camera matrix [f 0 cx; 0 f cy; 0 0 1]");
      }
    }
    if (values[0] <= 0.0)
    {
      fail(field, "a camera matrix [f 0 cx; 0 f cy; 0 0 1] with a positive focal length");
    }
    return values;
  }

private:
  [[noreturn]] void fail(const std::string& field, const std::string& wanted) const
  {
    throw InputError("In '" + file_.string() + "', " + field + " is '" + fields_.at(field) +
                     "'; it must be " + wanted + ".");
  }

  fs::path file_;
  Fields fields_;
};

CameraDescription cameraOf(const Calib& calib)
{
  const std::array<double, 9> left = calib.matrix("cam0");
  CameraDescription camera;
  camera.focal_length_px = left[0];
  camera.principal_point_px = cv::Point2d(left[2], left[5]);
  camera.baseline_m = calib.number("baseline").value_or(0.0) * M_PER_MM;
  double doffs = calib.has("cam1") ? calib.matrix("cam1")[2] - left[2] : 0.0;
  doffs = calib.number("doffs").value_or(doffs);
  camera.disparity_offset_px = doffs;
  camera.calibrated_width = static_cast<int>(calib.number("width").value_or(0.0));
  return camera;
}

std::optional<DisparityRange> rangeOf(const Calib& calib)
{
  const double least = calib.number("vmin").value_or(0.0);
  const double most = calib.number("vmax").value_or(calib.number("ndisp").value_or(0.0));
  const double width = calib.number("width").value_or(0.0);
  if (!(least < most) || (width > 0.0 && most > MAX_RANGE_OVER_WIDTH * width))
  {
    return std::nullopt;
  }
  return DisparityRange{static_cast<float>(least), static_cast<float>(most)};
}

}  // namespace

Recognition recognizeMiddlebury(const FolderListing& listing, const DatasetOptions& options)
{
  const fs::path file = listing.folder / CALIBRATION;
  if (!isFile(file))
  {
    return Recognition::no("there is no calib.txt");
  }
  const Calib calib(file);
  if (!calib.has("cam0"))
  {
    return Recognition::no("its calib.txt has no cam0");
  }
  Recognition pair = recognizeIndex(listing, options);
  if (!pair || (*pair).views.size() != 2)
  {
    pair = recognizePlaceWords(listing, options);
  }
  if (!pair || (*pair).views.size() != 2)
  {
    return Recognition::no("besides calib.txt there are not two images like im0 and im1");
  }
  FolderDescription description = std::move(*pair);
  description.format = "middlebury";
  description.place_claim = PlaceClaim::Stated;
  description.grid = cv::Rect(0, 0, 2, 1);
  const CameraDescription camera = cameraOf(calib);
  if (camera.baseline_m > 0.0)
  {
    description.camera = camera;
  }
  description.disparity_range = rangeOf(calib);
  for (const char* const name : TRUTHS)
  {
    if (!description.truth && isFile(listing.folder / name))
    {
      description.truth = listing.folder / name;
    }
  }
  return description;
}

}  // namespace light_field_depth
