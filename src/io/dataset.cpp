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
#include "light_field_depth/core/mask_sources.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

/// Far more than any camera has, and no overflow of their product.
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

/// The placed views that are to be decoded; `files` keeps theirs.
std::vector<View> chosenViews(const DatasetOptions& options, const PlacedViews& placed,
                              std::vector<ViewFile>& files)
{
  LightField without_images;
  without_images.views = placed.views;
  const auto reference = std::find_if(placed.views.begin(), placed.views.end(),
                                      [&](const View& view) { return view.grid == placed.reference; });
  if (!options.selection || placed.views.size() < 2 || reference == placed.views.end())
  {
    return placed.views;
  }
  without_images.reference_index = static_cast<std::size_t>(reference - placed.views.begin());
  std::vector<View> chosen = selectViews(without_images, options.selection(without_images)).views;
  std::vector<ViewFile> chosen_files;
  for (const View& view : chosen)
  {
    const auto same = std::find_if(placed.views.begin(), placed.views.end(),
                                   [&](const View& other) { return other.grid == view.grid; });
    chosen_files.push_back(files[static_cast<std::size_t>(same - placed.views.begin())]);
  }
  files = std::move(chosen_files);
  return chosen;
}

/// Grey and coloured views become alike. A grey reference makes all views grey:
/// its match in the colours of the others is worth little. @return sentences that say what was done
std::vector<std::string> makeAlike(std::vector<View>& views, const GridPosition& reference)
{
  std::vector<std::string> notes;
  const auto is_grey = [](const View& view) { return view.image.channels() == 1; };
  const auto greys = static_cast<std::size_t>(std::count_if(views.begin(), views.end(), is_grey));
  if (greys > 0 && greys < views.size())
  {
    const bool to_grey =
        std::any_of(views.begin(), views.end(),
                    [&](const View& view) { return view.grid == reference && is_grey(view); });
    for (View& view : views)
    {
      if (to_grey)
      {
        view.image = toGrey(view.image);
      }
      else if (is_grey(view))
      {
        const std::vector<cv::Mat> channels(3, view.image);
        cv::merge(channels, view.image);
      }
    }
    notes.push_back(to_grey ? std::to_string(views.size() - greys) +
                                  " coloured view(s) are read as grey, as the reference is."
                            : std::to_string(greys) +
                                  " grey view(s) among the coloured ones are read as colour.");
  }
  return notes;
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

void maskBlack(std::vector<View>& views, ThreadPool& pool)
{
  pool.parallelFor(0, static_cast<int>(views.size()), 1,
                   [&](int first, int /*last*/)
                   {
                     View& view = views[static_cast<std::size_t>(first)];
                     view.mask = bothKnown(view.mask, blackMask(view.image));
                   });
}

/// The camera of the options wins over that of the description, field by field.
void applyCamera(const CameraOptions& given, FolderDescription& description)
{
  const bool any =
      given.focal_length_px || given.baseline_m || given.principal_point_px || given.focus_distance_m;
  if (!any)
  {
    return;
  }
  CameraDescription camera = description.camera.value_or(CameraDescription());
  if (given.focal_length_px)
  {
    camera.focal_length_px = *given.focal_length_px;
    camera.calibrated_width = 0;
  }
  if (given.principal_point_px)
  {
    camera.principal_point_px = given.principal_point_px;
    camera.calibrated_width = 0;
  }
  if (given.baseline_m)
  {
    camera.baseline_m = given.baseline_m->x;
  }
  if (given.focus_distance_m)
  {
    camera.focus_distance_m = given.focus_distance_m;
    camera.disparity_offset_px.reset();
  }
  const bool has_baseline = camera.baseline_m > 0.0 || description.position_unit_m;
  if (!(camera.focal_length_px > 0.0 || camera.focal_length_per_side > 0.0) || !has_baseline)
  {
    throw InputError(
        "Depth in metres needs both the focal length and the baseline, and the dataset does not state the "
        "other one; give --focal-length and --baseline.");
  }
  description.camera = camera;
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

std::string toString(LayoutSource source)
{
  switch (source)
  {
    case LayoutSource::Option:
      return "option";
    case LayoutSource::Description:
      return "description";
    case LayoutSource::Images:
      return "images";
    case LayoutSource::Names:
      break;
  }
  return "names";
}

Dataset readDataset(const fs::path& folder, const DatasetOptions& options)
{
  FolderDescription description = describe(folder, options);
  if (options.frame && description.frames.empty())
  {
    throw InputError("The frame '" + *options.frame + "' is asked for, but '" + folder.string() +
                     "' holds a single light field; leave --frame out.");
  }
  ViewStore store(description.views, options.threads, options.max_megapixels);
  settleGrid(description, options, store);
  if (options.camera.baseline_m)
  {
    description.row_step_ratio = options.camera.baseline_m->y / options.camera.baseline_m->x;
  }
  const Layout layout = settleLayout(description, options, store);
  const PlacedViews placed = placeViews(folder, description, layout, options.reference);
  Dataset dataset;
  dataset.views_found = description.views.size();
  std::vector<View> views = chosenViews(options, placed, description.views);
  if (options.admit && !description.views.empty())
  {
    options.admit(views.size(), store.image(description.views.front().id));
  }
  store.decode(idsOf(description.views));

  dataset.format = description.format;
  dataset.place_claim = description.place_claim;
  dataset.order = layout.order;
  dataset.flip = placed.flip;
  dataset.layout_source = layout.source;
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    views[i].image = store.image(description.views[i].id);
    views[i].mask = store.mask(description.views[i].id);
    dataset.files.push_back(description.views[i].path);
  }
  const auto masked =
      std::count_if(views.begin(), views.end(), [](const View& view) { return !view.mask.empty(); });
  if (masked > 0)
  {
    description.notes.push_back(
        std::to_string(masked) + " of " + std::to_string(views.size()) +
        " views show nothing in parts (transparent, or not reached when they were rectified); "
        "these take no part.");
  }
  for (const std::string& note : makeAlike(views, placed.reference))
  {
    description.notes.push_back(note);
  }
  requireEqualImages(description.views, views);
  if (options.mask_black)
  {
    maskBlack(views, store.pool());
  }
  std::optional<Calibration> calibration;
  applyCamera(options.camera, description);
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
