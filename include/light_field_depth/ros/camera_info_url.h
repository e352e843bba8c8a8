#ifndef LIGHT_FIELD_DEPTH_ROS_CAMERA_INFO_URL_H
#define LIGHT_FIELD_DEPTH_ROS_CAMERA_INFO_URL_H

#include <string>
#include <vector>

#include <sensor_msgs/CameraInfo.h>

#include "light_field_depth/ros/view_array.h"

namespace light_field_depth
{
/// The file that a URL of camera_info_manager's kinds stands for: file:///folder/name.yaml,
/// package://package/name.yaml, or a plain path.
/// @throw InputError for another kind, or a package that is not there
std::string fileOfUrl(const std::string& url, const std::string& view_name);

/// Reads the calibration file of each view of an array that names one, as camera_calibration writes it.
/// @return one for each view; null where the array names none
/// @throw InputError that names the view and the file
std::vector<sensor_msgs::CameraInfoConstPtr> readCameraInfos(const ViewArray& array);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_ROS_CAMERA_INFO_URL_H
