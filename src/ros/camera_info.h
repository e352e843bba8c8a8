#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_CAMERA_INFO_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_CAMERA_INFO_H

#include <cstddef>

#include <sensor_msgs/CameraInfo.h>

namespace light_field_depth
{
// Entries of the projection matrix P, row by row.
constexpr std::size_t FX = 0;
constexpr std::size_t CX = 2;
constexpr std::size_t TX = 3;
constexpr std::size_t FY = 5;
constexpr std::size_t CY = 6;
constexpr std::size_t TY = 7;

/// The camera of the image as it comes: binning and region of interest, which K and P of the message do not
/// include, are applied to the size, K and P as image_geometry::PinholeCameraModel does, and cleared.
sensor_msgs::CameraInfo ofDeliveredImage(const sensor_msgs::CameraInfo& info);

/// Whether two messages describe the same camera, whenever they were sent.
bool sameCamera(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b);

/// Whether the camera's raw image needs rectification: it has distortion, or is turned by R.
bool isDistortedOrTurned(const sensor_msgs::CameraInfo& info);

/// Whether the message is that of a camera that has not been calibrated: P is zero.
bool isUncalibrated(const sensor_msgs::CameraInfo& info);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_CAMERA_INFO_H
