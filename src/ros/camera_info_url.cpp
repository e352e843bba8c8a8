#include "light_field_depth/ros/camera_info_url.h"

#include <cstddef>

#include <camera_calibration_parsers/parse.h>
#include <ros/package.h>
#include <boost/make_shared.hpp>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
bool startsWith(const std::string& text, const std::string& beginning)
{
  return text.compare(0, beginning.size(), beginning) == 0;
}

}  // namespace

std::string fileOfUrl(const std::string& url, const std::string& view_name)
{
  const std::string file = "file://";
  const std::string package = "package://";
  if (startsWith(url, file))
  {
    return url.substr(file.size());
  }
  if (startsWith(url, package))
  {
    const std::size_t slash = url.find('/', package.size());
    const std::string name = url.substr(package.size(), slash - package.size());
    const std::string folder = slash == std::string::npos ? "" : ros::package::getPath(name);
    if (folder.empty())
    {
      throw InputError(view_name + ": the camera_info_url '" + url + "' names the package '" + name +
                       "', which is not found; source its workspace, or give a file.");
    }
    return folder + url.substr(slash);
  }
  if (url.find("://") != std::string::npos)
  {
    throw InputError(view_name + ": the camera_info_url '" + url +
                     "' is of a kind that is not known; give file:///..., package://... or a path.");
  }
  return url;
}

std::vector<sensor_msgs::CameraInfoConstPtr> readCameraInfos(const ViewArray& array)
{
  std::vector<sensor_msgs::CameraInfoConstPtr> infos(array.views.size());
  for (std::size_t i = 0; i < infos.size(); ++i)
  {
    const ViewTopics& view = array.views[i];
    if (view.camera_info_url.empty())
    {
      continue;
    }
    const std::string file = fileOfUrl(view.camera_info_url, describe(view));
    std::string camera_name;
    const auto info = boost::make_shared<sensor_msgs::CameraInfo>();
    if (!camera_calibration_parsers::readCalibration(file, camera_name, *info))
    {
      throw InputError(describe(view) + ": the calibration file '" + file +
                       "' cannot be read; give one that camera_calibration wrote (.yaml or .ini).");
    }
    infos[i] = info;
  }
  return infos;
}

}  // namespace light_field_depth
