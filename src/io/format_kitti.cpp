// KITTI: image_2/000000_10.png and image_3/000000_10.png (in colour), or image_0 and image_1 (grey); the raw
// recordings have image_02/data/0000000000.png. Calibration: calib.txt of the odometry,
// calib_cam_to_cam/FRAME.txt or calib_cam_to_cam.txt.

#include <algorithm>
#include <array>
#include <sstream>

#include "io/dataset_format.h"
#include "io/frame_choice.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

constexpr std::array<std::array<const char*, 2>, 4> CAMERAS = {
    {{"image_2", "image_3"}, {"image_02", "image_03"}, {"image_0", "image_1"}, {"image_00", "image_01"}}};
constexpr std::array<const char*, 3> FORMS_OF_PROJECTION = {"P", "P_rect_0", "P_rect_"};

using Projection = std::array<double, 12>;  ///< 3 x 4, row by row

/// The matrix behind "P2:" or "P_rect_02:" in a calibration file.
std::optional<Projection> projectionOf(const std::string& text, char camera)
{
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    const std::string field = line.substr(0, line.find(':'));
    const bool is_it = std::any_of(FORMS_OF_PROJECTION.begin(), FORMS_OF_PROJECTION.end(),
                                   [&](const char* form) { return field == form + std::string(1, camera); });
    if (!is_it || field.size() == line.size())
    {
      continue;
    }
    std::istringstream numbers(line.substr(field.size() + 1));
    numbers.imbue(std::locale::classic());
    Projection projection{};
    if (std::all_of(projection.begin(), projection.end(),
                    [&](double& number) { return bool(numbers >> number); }))
    {
      return projection;
    }
  }
  return std::nullopt;
}

std::optional<CameraDescription> cameraOf(const fs::path& folder, const std::string& frame, char left,
                                          char right)
{
  for (const fs::path& file :
       {folder / "calib.txt", folder / "calib_cam_to_cam" / (frame + ".txt"), folder / "calib_cam_to_cam.txt",
        folder.parent_path() / "calib_cam_to_cam.txt"})
  {
    if (!isFile(file))
    {
      continue;
    }
    const std::string text = readFile(file);
    const auto of_left = projectionOf(text, left);
    const auto of_right = projectionOf(text, right);
    if (of_left && of_right && (*of_left)[0] > 0.0 && (*of_left)[3] > (*of_right)[3])
    {
      CameraDescription camera;
      camera.focal_length_px = (*of_left)[0];
      camera.principal_point_px = cv::Point2d((*of_left)[2], (*of_left)[6]);
      camera.baseline_m = ((*of_left)[3] - (*of_right)[3]) / (*of_left)[0];
      camera.disparity_offset_px = (*of_right)[2] - (*of_left)[2];
      return camera;
    }
  }
  return std::nullopt;
}

/// The images of a camera: in its folder, or in "data" inside of it.
std::vector<fs::path> imagesOf(const fs::path& folder)
{
  std::error_code error;
  const bool raw = fs::is_directory(folder / "data", error);
  return fs::is_directory(folder, error) ? listFolder(raw ? folder / "data" : folder).images
                                         : std::vector<fs::path>();
}

}  // namespace

Recognition recognizeKitti(const FolderListing& listing, const DatasetOptions& options)
{
  for (const auto& [left_name, right_name] : CAMERAS)
  {
    const std::vector<fs::path> left = imagesOf(listing.folder / left_name);
    const std::vector<fs::path> right = imagesOf(listing.folder / right_name);
    FolderDescription description;
    std::vector<std::string> names;
    for (const fs::path& image : left)
    {
      const auto same = std::find_if(right.begin(), right.end(),
                                     [&](const fs::path& other) { return other.stem() == image.stem(); });
      if (same != right.end())
      {
        names.push_back(image.stem().string());
      }
    }
    if (names.empty())
    {
      continue;
    }
    const std::string frame = names[chooseFrame(names, options.frame, description)];
    for (const auto* const images : {&left, &right})
    {
      const auto image = std::find_if(images->begin(), images->end(),
                                      [&](const fs::path& path) { return path.stem().string() == frame; });
      description.views.push_back({*image, {0, static_cast<int>(description.views.size())}, {}});
    }
    description.format = "kitti";
    description.place_claim = PlaceClaim::TwoNumbers;
    const std::string left_text = left_name;
    const std::string right_text = right_name;
    description.camera =
        cameraOf(listing.folder, frame.substr(0, frame.find('_')), left_text.back(), right_text.back());
    return description;
  }
  return Recognition::no("there are no image_2 and image_3 (or image_0 and image_1) with frames of one name");
}

}  // namespace light_field_depth
