#include "light_field_depth/io/dataset.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <system_error>
#include <utility>

#include "io/dataset_format.h"
#include "io/dataset_layout.h"
#include "io/folder_description.h"
#include "io/view_placement.h"
#include "io/view_store.h"
#include "light_field_depth/core/enum_names.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

constexpr int MAX_GRID_SIDE = 999;

constexpr EnumNames<Order, 2> ORDER_NAMES = {{
    {Order::RowMajor, "row-major"},
    {Order::ColumnMajor, "column-major"},
}};

constexpr EnumNames<Flip, 4> FLIP_NAMES = {{
    {Flip::None, "none"},
    {Flip::Rows, "rows"},
    {Flip::Columns, "columns"},
    {Flip::Both, "both"},
}};

FolderDescription describe(const fs::path& path, const DatasetOptions& options)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
  {
    throw InputError("The folder '" + path.string() + "' does not exist; check the path.");
  }
  if (status.type() == fs::file_type::directory)
  {
    return describeFolder(path, options);
  }
  if (status.type() == fs::file_type::regular && isImageFile(path))
  {
    return describeImage(path, options);
  }
  throw InputError("'" + path.string() + "' is not a folder" + (error ? " (" + error.message() + ")" : "") +
                   "; name the folder that holds the views, or one image with all of them.");
}

std::string imageText(const cv::Mat& image)
{
  return std::to_string(image.cols) + " x " + std::to_string(image.rows) + " pixels, " +
         (image.depth() == CV_8U ? "8" : "16") + " bits, " + (image.channels() == 1 ? "grey" : "colour");
}

void requireEqualImages(const std::vector<ViewFile>& files, const std::vector<View>& views)
{
  for (std::size_t i = 1; i < views.size(); ++i)
  {
    const cv::Mat& first = views.front().image;
    const cv::Mat& image = views[i].image;
    if (image.size() != first.size() || image.type() != first.type())
    {
      throw InputError("The views differ: '" + files[0].path.string() + "' has " + imageText(first) + ", '" +
                       files[i].path.string() + "' has " + imageText(image) +
                       "; all views must have one size and type.");
    }
  }
}

Calibration calibrationFrom(const CameraDescription& camera, const cv::Size& size, const PlacedViews& placed)
{
  const double scale =
      camera.calibrated_width > 0 ? static_cast<double>(size.width) / camera.calibrated_width : 1.0;
  Calibration calibration;
  calibration.focal_length_px = camera.focal_length_px > 0.0
                                    ? camera.focal_length_px * scale
                                    : camera.focal_length_per_side * std::max(size.width, size.height);
  calibration.baseline_m = camera.baseline_m > 0.0 ? camera.baseline_m : placed.step_m;
  calibration.disparity_offset_px = camera.disparity_offset_px.value_or(0.0) * scale;
  if (camera.focus_distance_m)
  {
    calibration.disparity_offset_px =
        calibration.focal_length_px * calibration.baseline_m / *camera.focus_distance_m;
  }
  // A pixel's centre is at an integer: the corner of the image is at -0.5.
  const cv::Point2d centre(0.5 * (size.width - 1), 0.5 * (size.height - 1));
  const cv::Point2d half(0.5, 0.5);
  const cv::Point2d point =
      camera.principal_point_px ? (*camera.principal_point_px + half) * scale - half : centre;
  // The principal points of a sheared light field move from view to view.
  calibration.principal_point_px = point + placed.reference_steps * calibration.disparity_offset_px;
  return calibration;
}

}  // namespace

std::string toString(Flip flip)
{
  return enumName(FLIP_NAMES, flip);
}

Flip flipFromString(const std::string& name)
{
  if (const auto value = findEnumValue(FLIP_NAMES, name))
  {
    return *value;
  }
  throw InputError("There is no flip '" + name + "'; choose auto, none, rows, columns or both.");
}

std::string toString(Order order)
{
  return enumName(ORDER_NAMES, order);
}

Order orderFromString(const std::string& name)
{
  if (const auto value = findEnumValue(ORDER_NAMES, name))
  {
    return *value;
  }
  throw InputError("There is no order '" + name + "'; choose auto, row-major or column-major.");
}

std::optional<Order> orderOption(const std::string& name)
{
  return name.empty() || name == "auto" ? std::nullopt : std::make_optional(orderFromString(name));
}

std::optional<Flip> flipOption(const std::string& name)
{
  return name.empty() || name == "auto" ? std::nullopt : std::make_optional(flipFromString(name));
}

cv::Size gridFromString(const std::string& option, const std::string& text)
{
  static const std::regex form(R"((\d{1,3})\s*[xX*]\s*(\d{1,3}))");
  std::smatch match;
  if (std::regex_match(text, match, form))
  {
    const cv::Size grid(std::stoi(match[2]), std::stoi(match[1]));
    if (grid.width >= 1 && grid.height >= 1 && grid.area() >= 2)
    {
      return grid;
    }
  }
  throw InputError(option + " is '" + text + "'; give rows and columns, from 1 to " +
                   std::to_string(MAX_GRID_SIDE) + ", as in 9x17.");
}

std::string toString(PlaceClaim claim)
{
  switch (claim)
  {
    case PlaceClaim::Stated:
      return "stated";
    case PlaceClaim::TwoNumbers:
      return "two numbers";
    case PlaceClaim::SingleNumber:
      break;
  }
  return "single number";
}

Dataset readDataset(const fs::path& folder, const DatasetOptions& options)
{
  FolderDescription description = describe(folder, options);
  ViewStore store(description.views, options.threads);
  settleGrid(description, options, store);
  const Layout layout = settleLayout(description, options, store);
  const PlacedViews placed = placeViews(folder, description, layout, options.reference);
  store.decode(idsOf(description.views));

  Dataset dataset;
  dataset.format = description.format;
  dataset.place_claim = description.place_claim;
  dataset.order = layout.order;
  dataset.flip = placed.flip;
  std::vector<View> views = placed.views;
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    views[i].image = store.image(description.views[i].id);
    dataset.files.push_back(description.views[i].path);
  }
  requireEqualImages(description.views, views);
  std::optional<Calibration> calibration;
  if (description.camera)
  {
    calibration = calibrationFrom(*description.camera, views.front().image.size(), placed);
  }
  dataset.light_field = makeLightField(std::move(views), placed.reference, calibration);
  if (placed.own_layout)
  {
    dataset.disparity_range = description.disparity_range;
  }
  if (placed.own_layout && placed.own_reference)
  {
    dataset.truth = description.truth;
  }
  dataset.frames = std::move(description.frames);
  dataset.notes = std::move(description.notes);
  dataset.warnings = std::move(description.warnings);
  return dataset;
}

}  // namespace light_field_depth
