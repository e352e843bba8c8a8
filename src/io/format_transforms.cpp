// Poses in JSON: transforms.json of NeRF tools, lightfield.json of the IDLab add-on for Blender.

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "io/dataset_format.h"
#include "io/planar_rig.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;
using Json = nlohmann::json;

/// The axes of OpenGL's and Blender's cameras (y upwards, z backwards) in ours.
const cv::Matx33d OPENGL_AXES(1, 0, 0, 0, -1, 0, 0, 0, -1);

/// Calls read(json). @throw InputError that names the file if it is no JSON or a field is missing or of
/// another type
template <class Read>
FolderDescription readJson(const fs::path& file, const Read& read)
{
  const std::string text = readFile(file);
  try
  {
    return read(Json::parse(text));
  }
  catch (const Json::exception& error)
  {
    throw InputError("'" + file.string() + "' cannot be used: " + error.what() + ".");
  }
}

/// Takes the pose from a matrix from the camera to the world. @throw Json::exception
void readPose(const Json& matrix, PosedImage& image)
{
  cv::Matx33d rotation;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      rotation(row, column) =
          matrix.at(static_cast<std::size_t>(row)).at(static_cast<std::size_t>(column)).get<double>();
    }
    image.centre[row] = matrix.at(static_cast<std::size_t>(row)).at(3).get<double>();
  }
  image.rotation = nearestRotation(rotation, image.path.filename().string()) * OPENGL_AXES;
}

double focalLength(int width, double angle)
{
  return 0.5 * width / std::tan(0.5 * angle);
}

void requireFocalLength(const fs::path& file, const Intrinsics& camera)
{
  if (!(std::isfinite(camera.fx) && camera.fx > 0.0 && std::isfinite(camera.fy) && camera.fy > 0.0))
  {
    throw InputError("'" + file.string() + "' states no focal length.");
  }
}

/// A frame's own intrinsics, or those of the whole file.
Intrinsics transformsCamera(const Json& top, const Json& frame, const cv::Size& size)
{
  const auto value = [&](const char* name, double otherwise)
  { return frame.value(name, top.value(name, otherwise)); };
  Intrinsics camera;
  camera.size = {static_cast<int>(value("w", size.width)), static_cast<int>(value("h", size.height))};
  camera.fx = value("fl_x", focalLength(camera.size.width, value("camera_angle_x", 0.0)));
  camera.fy = value("fl_y", camera.fx);
  camera.cx = value("cx", 0.5 * camera.size.width) - 0.5;
  camera.cy = value("cy", 0.5 * camera.size.height) - 0.5;
  camera.k1 = value("k1", 0.0);
  camera.k2 = value("k2", 0.0);
  camera.p1 = value("p1", 0.0);
  camera.p2 = value("p2", 0.0);
  return camera;
}

std::vector<std::string> missingNote(std::size_t missing)
{
  return missing > 0
             ? std::vector<std::string>{std::to_string(missing) + " of the described images are not there."}
             : std::vector<std::string>();
}

}  // namespace

Recognition recognizeTransforms(const FolderListing& listing, const DatasetOptions& /*options*/)
{
  fs::path file = listing.folder / "transforms.json";
  if (!isFile(file))
  {
    file = listing.folder / "transforms_train.json";  // the part to learn from, where there are several
  }
  if (!isFile(file))
  {
    return Recognition::no("there is no transforms.json");
  }
  return readJson(file,
                  [&](const Json& top)
                  {
                    std::vector<PosedImage> images;
                    std::size_t missing = 0;
                    cv::Size size;
                    for (const Json& frame : top.at("frames"))
                    {
                      PosedImage image;
                      image.path = findFrame(listing.folder, frame.at("file_path").get<std::string>());
                      if (image.path.empty())
                      {
                        ++missing;
                        continue;
                      }
                      if (size.empty() && !top.contains("w") && !frame.contains("w"))
                      {
                        size = readImage(image.path).size();
                      }
                      image.intrinsics = transformsCamera(top, frame, size);
                      requireFocalLength(file, image.intrinsics);
                      readPose(frame.at("transform_matrix"), image);
                      images.push_back(image);
                    }
                    FolderDescription description = describeRig(listing.folder, images, 1.0);
                    description.format = "transforms";
                    for (const std::string& note : missingNote(missing))
                    {
                      description.notes.push_back(note);
                    }
                    return description;
                  });
}

Recognition recognizeIdLab(const FolderListing& listing, const DatasetOptions& /*options*/)
{
  const fs::path file = listing.folder / "lightfield.json";
  if (!isFile(file))
  {
    return Recognition::no("there is no lightfield.json");
  }
  return readJson(
      file,
      [&](const Json& top)
      {
        const Json& camera = top.at("camera");
        Intrinsics intrinsics;
        intrinsics.size = {top.at("resolution").at(0).get<int>(), top.at("resolution").at(1).get<int>()};
        const int longer = std::max(intrinsics.size.width, intrinsics.size.height);
        intrinsics.fx = camera.contains("angle")
                            ? focalLength(longer, camera.at("angle").get<double>())
                            : camera.at("focal_length").get<double>() * intrinsics.size.width /
                                  top.at("sensor_size").at(0).get<double>();
        intrinsics.fy = intrinsics.fx;
        intrinsics.cx = 0.5 * (intrinsics.size.width - 1);
        intrinsics.cy = 0.5 * (intrinsics.size.height - 1);
        requireFocalLength(file, intrinsics);
        std::vector<PosedImage> images;
        std::size_t missing = 0;
        for (const Json& frame : top.at("frames"))
        {
          PosedImage image;
          image.path = findFrame(listing.folder, frame.at("name").get<std::string>());
          if (image.path.empty())
          {
            ++missing;
            continue;
          }
          image.intrinsics = intrinsics;
          readPose(frame.at("world_matrix"), image);
          images.push_back(image);
        }
        FolderDescription description = describeRig(listing.folder, images, 1.0);
        description.format = "idlab";
        for (const std::string& note : missingNote(missing))
        {
          description.notes.push_back(note);
        }
        return description;
      });
}

}  // namespace light_field_depth
