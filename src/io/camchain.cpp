#include "light_field_depth/io/camchain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <yaml-cpp/yaml.h>

#include "io/planar_rig.h"
#include "io/yaml_fields.h"
#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

constexpr double DEG_PER_RAD = 57.29577951308232;
constexpr std::size_t DISTORTION_COEFFICIENTS = 4;

/// Where a camera stands in the frame of the first one.
struct Pose
{
  cv::Matx33d rotation = cv::Matx33d::eye();  ///< from the camera's axes
  cv::Vec3d centre;
};

std::vector<double> numbers(const YamlFields& fields, const std::string& field, std::size_t count)
{
  const std::string wanted = "a list of " + std::to_string(count) + " numbers";
  const auto values = fields.get<std::vector<double>>(field, wanted);
  if (!values || values->size() != count ||
      !std::all_of(values->begin(), values->end(), [](double value) { return std::isfinite(value); }))
  {
    fields.fail(field, wanted);
  }
  return *values;
}

void readDistortion(const YamlFields& fields, RectifiedCamera& camera)
{
  const std::string model =
      fields.get<std::string>("distortion_model", "radtan, equidistant or none").value_or("none");
  if (model == "none")
  {
    camera.distortion_model = "plumb_bob";
    camera.distortion.assign(DISTORTION_COEFFICIENTS + 1, 0.0);
  }
  else if (model == "radtan" || model == "equidistant")
  {
    camera.distortion = numbers(fields, "distortion_coeffs", DISTORTION_COEFFICIENTS);
    camera.distortion_model = model;
    if (model == "radtan")
    {
      camera.distortion_model = "plumb_bob";
      camera.distortion.push_back(0.0);  // k3
    }
  }
  else
  {
    fields.fail("distortion_model", "radtan, equidistant or none");
  }
}

RectifiedCamera readCamera(const YamlFields& fields, const std::string& name)
{
  RectifiedCamera camera;
  camera.name = name;
  if (fields.get<std::string>("camera_model", "pinhole").value_or("pinhole") != "pinhole")
  {
    fields.fail("camera_model", "pinhole; calibrate with another model");
  }
  const std::vector<double> k = numbers(fields, "intrinsics", 4);
  if (!(k[0] > 0.0 && k[1] > 0.0))
  {
    fields.fail("intrinsics", "fx, fy, cx and cy, with positive focal lengths");
  }
  camera.camera_matrix = cv::Matx33d(k[0], 0.0, k[2], 0.0, k[1], k[3], 0.0, 0.0, 1.0);
  readDistortion(fields, camera);
  const auto size = fields.integerPair("resolution", "width and height in pixels");
  if (!size || size->first < 1 || size->second < 1)
  {
    fields.fail("resolution", "width and height in pixels");
  }
  camera.size = {size->first, size->second};
  camera.topic = fields.get<std::string>("rostopic", "a topic").value_or("");
  return camera;
}

/// T_cn_cnm1 takes points from the axes of the camera before to this one's.
Pose nextPose(const YamlFields& fields, const std::string& name, const Pose& before)
{
  const std::string wanted = "4 rows of 4 numbers";
  const auto rows = fields.get<std::vector<std::vector<double>>>("T_cn_cnm1", wanted);
  if (!rows || rows->size() != 4 ||
      !std::all_of(rows->begin(), rows->end(), [](const auto& row) { return row.size() == 4; }))
  {
    fields.fail("T_cn_cnm1", wanted);
  }
  cv::Matx33d turn;
  cv::Vec3d shift;
  for (int row = 0; row < 3; ++row)
  {
    const std::vector<double>& values = (*rows)[static_cast<std::size_t>(row)];
    for (int column = 0; column < 3; ++column)
    {
      turn(row, column) = values[static_cast<std::size_t>(column)];
    }
    shift[row] = values[3];
  }
  const cv::Matx33d to_before = nearestRotation(turn, name).t();
  return {before.rotation * to_before, before.centre - before.rotation * (to_before * shift)};
}

std::string cameraName(std::size_t index)
{
  return "cam" + std::to_string(index);
}

cv::Matx34d projectionOf(const Intrinsics& common, const cv::Point2d& position_m)
{
  return {common.fx, 0.0,       common.cx, -common.fx * position_m.x,
          0.0,       common.fy, common.cy, -common.fy * position_m.y,
          0.0,       0.0,       1.0,       0.0};
}

double turnDeg(const cv::Matx33d& rotation)
{
  return std::acos(std::clamp(0.5 * (cv::trace(rotation) - 1.0), -1.0, 1.0)) * DEG_PER_RAD;
}

std::size_t middleView(const std::vector<RectifiedCamera>& cameras)
{
  cv::Point2d middle;
  for (const RectifiedCamera& camera : cameras)
  {
    middle += cv::Point2d(camera.grid.column, camera.grid.row) * (1.0 / static_cast<double>(cameras.size()));
  }
  const auto distance = [&](const RectifiedCamera& camera)
  { return cv::norm(cv::Point2d(camera.grid.column, camera.grid.row) - middle); };
  const auto nearest = std::min_element(cameras.begin(), cameras.end(),
                                        [&](const RectifiedCamera& a, const RectifiedCamera& b)
                                        { return distance(a) < distance(b) - 1e-9; });
  return static_cast<std::size_t>(nearest - cameras.begin());
}

}  // namespace

RectifiedRig rectifyCamchain(const fs::path& file)
{
  const YamlFields chain(file, "", loadYaml(file));
  RectifiedRig rig;
  std::vector<PosedImage> poses;
  Pose pose;
  for (std::size_t i = 0; chain.has(cameraName(i)); ++i)
  {
    const std::string name = cameraName(i);
    const YamlFields fields(file, name, chain.node(name));
    rig.cameras.push_back(readCamera(fields, name));
    const RectifiedCamera& camera = rig.cameras.back();
    if (camera.size != rig.cameras.front().size)
    {
      fields.fail("resolution", "that of cam0; all views of an array have one size");
    }
    pose = i == 0 ? pose : nextPose(fields, name, pose);
    Intrinsics intrinsics;
    intrinsics.size = camera.size;
    intrinsics.fx = camera.camera_matrix(0, 0);
    intrinsics.fy = camera.camera_matrix(1, 1);
    poses.push_back({name, intrinsics, pose.rotation, pose.centre});
  }
  if (rig.cameras.size() < 2)
  {
    throw InputError("'" + file.string() +
                     "' describes no two cameras (cam0, cam1, ...); give the camchain of a whole array.");
  }
  const CommonPlane plane = fitCommonPlane(file, poses);
  const std::vector<GridPosition> grid = numberCameras(plane);
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    RectifiedCamera& camera = rig.cameras[i];
    camera.grid = grid[i];
    camera.rectification = plane.rotation.t() * poses[i].rotation;
    camera.turn_deg = turnDeg(camera.rectification);
    camera.off_plane_m = plane.off_plane[i];
    rig.off_plane_m = std::max(rig.off_plane_m, std::abs(camera.off_plane_m));
  }
  rig.width_m = plane.width;
  rig.reference = middleView(rig.cameras);
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    rig.cameras[i].projection =
        projectionOf(plane.common, plane.positions[i] - plane.positions[rig.reference]);
  }
  const GridPosition reference = rig.cameras[rig.reference].grid;
  std::sort(rig.cameras.begin(), rig.cameras.end(),
            [](const RectifiedCamera& a, const RectifiedCamera& b) { return a.grid < b.grid; });
  rig.reference = static_cast<std::size_t>(std::find_if(rig.cameras.begin(), rig.cameras.end(),
                                                        [&](const RectifiedCamera& camera)
                                                        { return camera.grid == reference; }) -
                                           rig.cameras.begin());
  return rig;
}

}  // namespace light_field_depth
