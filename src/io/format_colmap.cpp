// Poses by COLMAP: cameras.txt and images.txt of a sparse model in text.

#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "io/dataset_format.h"
#include "io/planar_rig.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

constexpr std::array<const char*, 4> MODEL_FOLDERS = {"", "sparse", "sparse/0", "text"};

/// The lines of a file without comments; `keep_empty` for images.txt, where a line of points may be empty.
std::vector<std::string> linesOf(const fs::path& file, bool keep_empty)
{
  std::vector<std::string> lines;
  std::istringstream stream(readFile(file));
  for (std::string line; std::getline(stream, line);)
  {
    if (!line.empty() && line.back() == '\r')
    {
      line.pop_back();
    }
    if ((line.empty() && !keep_empty) || (!line.empty() && line.front() == '#'))
    {
      continue;
    }
    lines.push_back(line);
  }
  return lines;
}

[[noreturn]] void failLine(const fs::path& file, const std::string& line, const std::string& wanted)
{
  throw InputError("In '" + file.string() + "', the line '" + line.substr(0, 120) + "' is not " + wanted +
                   ".");
}

Intrinsics intrinsicsOf(const fs::path& file, const std::string& line, int& id)
{
  std::istringstream stream(line);
  stream.imbue(std::locale::classic());
  std::string model;
  Intrinsics camera;
  stream >> id >> model >> camera.size.width >> camera.size.height;
  std::vector<double> values;
  for (double value = 0.0; stream >> value;)
  {
    values.push_back(value);
  }
  const auto is = [&](const char* name, std::size_t count)
  { return model == name && values.size() == count; };
  const bool one_focal_length = is("SIMPLE_PINHOLE", 3) || is("SIMPLE_RADIAL", 4) || is("RADIAL", 5);
  if (!one_focal_length && !is("PINHOLE", 4) && !is("OPENCV", 8))
  {
    failLine(file, line,
             "a camera of the model SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL or OPENCV; "
             "undistort the images with COLMAP");
  }
  const std::size_t shift = one_focal_length ? 1 : 2;
  camera.fx = values[0];
  camera.fy = one_focal_length ? values[0] : values[1];
  // COLMAP counts from the corner of the image, we from the centre of the first pixel.
  camera.cx = values[shift] - 0.5;
  camera.cy = values[shift + 1] - 0.5;
  const std::array<double*, 4> distortion = {&camera.k1, &camera.k2, &camera.p1, &camera.p2};
  for (std::size_t i = shift + 2; i < values.size(); ++i)
  {
    *distortion[i - shift - 2] = values[i];
  }
  if (!(camera.fx > 0.0 && camera.fy > 0.0 && camera.size.width > 0 && camera.size.height > 0))
  {
    failLine(file, line, "a camera with a positive size and focal length");
  }
  return camera;
}

cv::Matx33d rotationOf(double w, double x, double y, double z)
{
  return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
          2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
          2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
}

}  // namespace

Recognition recognizeColmap(const FolderListing& listing, const DatasetOptions& /*options*/)
{
  fs::path model;
  for (const char* const inside : MODEL_FOLDERS)
  {
    const fs::path folder = listing.folder / inside;
    if (isFile(folder / "cameras.bin") && !isFile(folder / "cameras.txt"))
    {
      return Recognition::no("the model is binary: colmap model_converter --output_type TXT makes it text");
    }
    if (isFile(folder / "cameras.txt") && isFile(folder / "images.txt"))
    {
      model = folder;
      break;
    }
  }
  if (model.empty())
  {
    return Recognition::no("there are no cameras.txt and images.txt");
  }
  std::map<int, Intrinsics> cameras;
  for (const std::string& line : linesOf(model / "cameras.txt", false))
  {
    int id = 0;
    const Intrinsics camera = intrinsicsOf(model / "cameras.txt", line, id);
    cameras[id] = camera;
  }
  std::vector<PosedImage> images;
  std::size_t missing = 0;
  const std::vector<std::string> lines = linesOf(model / "images.txt", true);
  for (std::size_t i = 0; i < lines.size(); i += 2)
  {
    std::istringstream stream(lines[i]);
    stream.imbue(std::locale::classic());
    int id = 0;
    int camera_id = 0;
    cv::Vec4d q;
    cv::Vec3d t;
    std::string name;
    if (!(stream >> id >> q[0] >> q[1] >> q[2] >> q[3] >> t[0] >> t[1] >> t[2] >> camera_id >> std::ws) ||
        !std::getline(stream, name) || cameras.count(camera_id) == 0 || !(cv::norm(q) > 0.0))
    {
      failLine(model / "images.txt", lines[i],
               "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME of a known camera");
    }
    q = cv::normalize(q);
    PosedImage image;
    image.path = findFrame(listing.folder, name);
    image.intrinsics = cameras[camera_id];
    image.rotation = rotationOf(q[0], q[1], q[2], q[3]).t();
    image.centre = -(image.rotation * t);
    missing += image.path.empty() ? 1 : 0;
    if (!image.path.empty())
    {
      images.push_back(image);
    }
  }
  FolderDescription description = describeRig(listing.folder, images, 1.0);
  description.format = "colmap";
  description.notes.emplace_back("COLMAP knows no metres: depth is in the unit of its model.");
  if (missing > 0)
  {
    description.notes.push_back(std::to_string(missing) + " images of the model are not there.");
  }
  return description;
}

}  // namespace light_field_depth
