#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>

#include <camera_calibration_parsers/parse_yml.h>
#include <sensor_msgs/CameraInfo.h>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/camchain.h"
#include "light_field_depth/io/files.h"
#include "tools/tool_main.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

struct CalibrateOptions
{
  std::string camchain;
  std::string output;
  std::string image_topic = "view_{row}_{column}/image_raw";
};

sensor_msgs::CameraInfo infoOf(const RectifiedCamera& camera)
{
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.size.width);
  info.height = static_cast<std::uint32_t>(camera.size.height);
  info.distortion_model = camera.distortion_model;
  info.D = camera.distortion;
  std::copy(camera.camera_matrix.val, camera.camera_matrix.val + info.K.size(), info.K.begin());
  std::copy(camera.rectification.val, camera.rectification.val + info.R.size(), info.R.begin());
  std::copy(camera.projection.val, camera.projection.val + info.P.size(), info.P.begin());
  return info;
}

std::string replaced(std::string text, const std::string& what, int number)
{
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what))
  {
    text.replace(at, what.size(), std::to_string(number));
  }
  return text;
}

std::string topicOf(const RectifiedCamera& camera, const std::string& pattern)
{
  return camera.topic.empty()
             ? replaced(replaced(pattern, "{row}", camera.grid.row), "{column}", camera.grid.column)
             : camera.topic;
}

/// The array's description for depth.launch: raw images, rectified by the files.
std::string arrayYaml(const RectifiedRig& rig, const fs::path& folder, const CalibrateOptions& options)
{
  const GridPosition& reference = rig.cameras[rig.reference].grid;
  std::ostringstream text;
  text << "# Written by calibrate_array from " << fs::path(options.camchain).filename().string() << ".\n"
       << "rectify: true\narray:\n  reference: [" << reference.row << ", " << reference.column
       << "]\n  views:\n";
  for (const RectifiedCamera& camera : rig.cameras)
  {
    text << "    - {row: " << camera.grid.row << ", column: " << camera.grid.column << ", image: '"
         << topicOf(camera, options.image_topic) << "',\n       camera_info_url: 'file://"
         << (folder / (camera.name + ".yaml")).string() << "'}\n";
  }
  return text.str();
}

void report(const RectifiedRig& rig, const fs::path& folder)
{
  std::cout << rig.cameras.size() << " cameras, " << std::fixed << std::setprecision(1) << 1e3 * rig.width_m
            << " mm wide, up to " << 1e3 * rig.off_plane_m << " mm away from their plane ("
            << 100.0 * rig.off_plane_m / rig.width_m << " % of the width)\n";
  for (const RectifiedCamera& camera : rig.cameras)
  {
    const cv::Matx34d& p = camera.projection;
    std::cout << "  " << camera.name << ": row " << camera.grid.row << ", column " << camera.grid.column
              << ", at (" << std::setprecision(1) << -1e3 * p(0, 3) / p(0, 0) << ", "
              << -1e3 * p(1, 3) / p(1, 1) << ") mm, turned by " << std::setprecision(2) << camera.turn_deg
              << " degrees\n";
  }
  std::cout << "Wrote the calibration files and " << (folder / "array.yaml").string()
            << "; try: roslaunch light_field_depth depth.launch array_file:="
            << (folder / "array.yaml").string() << std::endl;
}

void calibrate(const CalibrateOptions& options)
{
  const RectifiedRig rig = rectifyCamchain(options.camchain);
  const fs::path folder = fs::absolute(options.output).lexically_normal();
  makeFolder(folder);
  for (const RectifiedCamera& camera : rig.cameras)
  {
    std::ostringstream text;
    if (!camera_calibration_parsers::writeCalibrationYml(text, camera.name, infoOf(camera)))
    {
      throw InputError("The calibration of " + camera.name + " cannot be written as YAML.");
    }
    writeFile(folder / (camera.name + ".yaml"), text.str());
  }
  writeFile(folder / "array.yaml", arrayYaml(rig, folder, options));
  report(rig, folder);
}

}  // namespace
}  // namespace light_field_depth

int main(int argc, char** argv)
{
  using namespace light_field_depth;
  CLI::App app(
      "Finds the common rectified plane of calibrated cameras, and writes a calibration file for each and "
      "the "
      "description of the array.",
      "calibrate_array");
  CalibrateOptions options;
  app.add_option("--camchain", options.camchain, "What Kalibr wrote: camchain-*.yaml")->required();
  app.add_option("--output", options.output, "Folder for camN.yaml and array.yaml")->required();
  app.add_option("--image-topic", options.image_topic, "Pattern of the topics, for cameras without rostopic")
      ->capture_default_str();
  return runTool(app, argc, argv, [&] { calibrate(options); });
}
