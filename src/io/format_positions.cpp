// Names with camera positions: out_RR_CC_Y_X of the Stanford archive, with or without a '_' at the end, and
// NAME_RR_CC_Y_X_FOCALmm_SENSORmm of an exporter for Blender (positions in millimetres).

#include <regex>

#include "io/dataset_format.h"
#include "io/name_groups.h"
#include "io/number_text.h"

namespace light_field_depth
{
namespace
{
constexpr double M_PER_MM = 1e-3;  // the names have millimetres

struct PositionName
{
  ViewFile view;
  std::optional<double> focal_length_per_side;
};

std::optional<PositionName> parse(const std::filesystem::path& path)
{
  // A position of a name that does not begin with out_ has a point: without it, it could be anything.
  static const std::regex stanford(
      R"(out_(\d{1,5})_(\d{1,5})_(-?\d{1,9}(?:\.\d*)?)_(-?\d{1,9}(?:\.\d*)?)_?)");
  static const std::regex blender(
      R"((?:.*_)?(\d{1,5})_(\d{1,5})_(-?\d{1,9}\.\d*)_(-?\d{1,9}\.\d*)(?:_(\d{1,5}(?:\.\d*)?)(?:mm)?_(\d{1,5}(?:\.\d*)?)(?:mm)?)?_?)");
  const std::string stem = path.stem().string();
  std::smatch match;
  const bool is_stanford = std::regex_match(stem, match, stanford);
  if (!is_stanford && !std::regex_match(stem, match, blender))
  {
    return std::nullopt;
  }
  PositionName name;
  name.view = {path,
               {std::stoi(match[1]), std::stoi(match[2])},
               cv::Point2d(numberFromText<double>(match[4]).value_or(0.0),
                           numberFromText<double>(match[3]).value_or(0.0))};
  if (!is_stanford && match[5].matched)
  {
    const double focal_length_mm = numberFromText<double>(match[5]).value_or(0.0);
    const double sensor_mm = numberFromText<double>(match[6]).value_or(0.0);
    if (focal_length_mm > 0.0 && sensor_mm > 0.0)
    {
      name.focal_length_per_side = focal_length_mm / sensor_mm;
    }
  }
  return name;
}

}  // namespace

Recognition recognizePositions(const FolderListing& listing, const DatasetOptions& /*options*/)
{
  FolderDescription description;
  description.format = "stanford";
  std::vector<std::filesystem::path> others;
  std::optional<double> focal_length_per_side;
  for (const auto& image : listing.images)
  {
    if (const auto name = parse(image))
    {
      description.views.push_back(name->view);
      focal_length_per_side = name->focal_length_per_side;
    }
    else
    {
      others.push_back(image);
    }
  }
  if (description.views.empty())
  {
    return Recognition::no("no name has a position");
  }
  if (focal_length_per_side)
  {
    description.format = "blender";
    CameraDescription camera;
    camera.focal_length_per_side = *focal_length_per_side;
    description.camera = camera;
    description.position_unit_m = M_PER_MM;
  }
  description.notes = leftOutNotes(others);
  return description;
}

}  // namespace light_field_depth
