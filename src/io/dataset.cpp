#include "light_field_depth/io/dataset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>
#include <utility>

#include "io/folder_description.h"
#include "io/view_placement.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/core/thread_pool.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* DESCRIPTION_FILE = "light_field.yaml";

constexpr std::array<std::pair<Flip, const char*>, 4> FLIP_NAMES = {{
    {Flip::None, "none"},
    {Flip::Rows, "rows"},
    {Flip::Columns, "columns"},
    {Flip::Both, "both"},
}};

FolderDescription describe(const fs::path& folder)
{
  std::error_code error;
  if (!fs::exists(folder, error))
  {
    throw InputError("The folder '" + folder.string() + "' does not exist; check the path.");
  }
  if (!fs::is_directory(folder, error))
  {
    throw InputError("'" + folder.string() + "' is not a folder; name the folder that holds the views.");
  }
  const fs::path yaml_file = folder / DESCRIPTION_FILE;
  return fs::exists(yaml_file) ? describeByYaml(yaml_file) : describeByNames(folder);
}

/// All images in the order of the views; the failure of the first view that fails is thrown.
std::vector<cv::Mat> decodeAll(const std::vector<ViewFile>& views, int threads)
{
  std::vector<cv::Mat> images(views.size());
  std::vector<std::string> failures(views.size());
  ThreadPool pool(threads);
  pool.parallelFor(0, static_cast<int>(views.size()), 1,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       try
                       {
                         images[i] = readImage(views[i].path);
                       }
                       catch (const InputError& error)
                       {
                         failures[i] = error.what();
                       }
                     }
                   });
  const auto failure =
      std::find_if(failures.begin(), failures.end(), [](const std::string& text) { return !text.empty(); });
  if (failure != failures.end())
  {
    throw InputError(*failure);
  }
  return images;
}

std::string imageText(const cv::Mat& image)
{
  return std::to_string(image.cols) + " x " + std::to_string(image.rows) + " pixels, " +
         (image.depth() == CV_8U ? "8" : "16") + " bits, " + (image.channels() == 1 ? "grey" : "colour");
}

void requireEqualImages(const std::vector<ViewFile>& views, const std::vector<cv::Mat>& images)
{
  for (std::size_t i = 1; i < images.size(); ++i)
  {
    if (images[i].size() != images[0].size() || images[i].type() != images[0].type())
    {
      throw InputError("The views differ: '" + views[0].path.string() + "' has " + imageText(images[0]) +
                       ", '" + views[i].path.string() + "' has " + imageText(images[i]) +
                       "; all views must have one size and type.");
    }
  }
}

Calibration calibrationFrom(const CameraDescription& camera, const cv::Size& size, const cv::Point2d& steps)
{
  Calibration calibration;
  calibration.focal_length_px = camera.focal_length_px > 0.0
                                    ? camera.focal_length_px
                                    : camera.focal_length_per_side * std::max(size.width, size.height);
  calibration.baseline_m = camera.baseline_m;
  if (camera.focus_distance_m)
  {
    calibration.disparity_offset_px =
        calibration.focal_length_px * calibration.baseline_m / *camera.focus_distance_m;
  }
  const cv::Point2d centre(0.5 * (size.width - 1), 0.5 * (size.height - 1));
  // The principal points of a sheared light field move from view to view.
  calibration.principal_point_px =
      camera.principal_point_px.value_or(centre) + steps * calibration.disparity_offset_px;
  return calibration;
}

}  // namespace

std::string toString(Flip flip)
{
  const auto* const found = std::find_if(FLIP_NAMES.begin(), FLIP_NAMES.end(),
                                         [&](const auto& entry) { return entry.first == flip; });
  return found->second;
}

Flip flipFromString(const std::string& name)
{
  const auto* const found = std::find_if(FLIP_NAMES.begin(), FLIP_NAMES.end(),
                                         [&](const auto& entry) { return name == entry.second; });
  if (found == FLIP_NAMES.end())
  {
    throw InputError("There is no flip '" + name + "'; choose none, rows, columns or both.");
  }
  return found->first;
}

Dataset readDataset(const fs::path& folder, const DatasetOptions& options)
{
  FolderDescription description = describe(folder);
  const PlacedViews placed = placeViews(folder, description, options);
  const std::vector<cv::Mat> images = decodeAll(description.views, options.threads);
  requireEqualImages(description.views, images);

  Dataset dataset;
  dataset.format = description.format;
  dataset.flip = placed.flip;
  std::vector<View> views = placed.views;
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    views[i].image = images[i];
    dataset.files.push_back(description.views[i].path);
  }
  std::optional<Calibration> calibration;
  if (description.camera)
  {
    calibration = calibrationFrom(*description.camera, images.front().size(), placed.reference_steps);
  }
  dataset.light_field = makeLightField(std::move(views), placed.reference, calibration);
  if (placed.own_flip)
  {
    dataset.disparity_range = description.disparity_range;
  }
  if (placed.own_flip && placed.own_reference)
  {
    dataset.truth = description.truth;
  }
  return dataset;
}

}  // namespace light_field_depth
