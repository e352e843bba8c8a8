#ifndef LIGHT_FIELD_DEPTH_IO_CAMCHAIN_H
#define LIGHT_FIELD_DEPTH_IO_CAMCHAIN_H

#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// A raw camera of a rig, and what rectifies it to the plane of the rig; fields as in sensor_msgs/CameraInfo.
struct RectifiedCamera
{
  std::string name;                ///< "cam0"
  std::string topic;               ///< of its raw images; empty if the file names none
  GridPosition grid;               ///< rows downwards, columns to the right, from 0
  cv::Size size;                   ///< of its images, pixels
  cv::Matx33d camera_matrix;       ///< K
  std::string distortion_model;    ///< "plumb_bob" or "equidistant"
  std::vector<double> distortion;  ///< D
  cv::Matx33d rectification;       ///< R: from the camera's axes to those of the plane
  cv::Matx34d projection;          ///< P, with the position relative to the reference view in metres
  double turn_deg = 0.0;           ///< that R turns it by
  double off_plane_m = 0.0;        ///< its distance from the plane, along the normal
};

/// The cameras of a rig, rectified to one plane, row by row.
struct RectifiedRig
{
  std::vector<RectifiedCamera> cameras;  ///< row by row
  std::size_t reference = 0;             ///< index of the view nearest the middle
  double width_m = 0.0;                  ///< of the rig
  double off_plane_m = 0.0;              ///< the farthest distance of a camera from the plane
};

/// Reads a camera chain of Kalibr (camchain.yaml: cam0, cam1, ... with camera_model pinhole, intrinsics,
/// distortion_model radtan, equidistant or none, distortion_coeffs, resolution, T_cn_cnm1, and rostopic) and
/// finds the common plane: through the cameras, or through their row and facing as they do on average.
/// @throw InputError that names the file, the camera and the field; or that says how far from a plane the
/// cameras
///   stand, or which one looks elsewhere, when they cannot be rectified
RectifiedRig rectifyCamchain(const std::filesystem::path& file);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_CAMCHAIN_H
