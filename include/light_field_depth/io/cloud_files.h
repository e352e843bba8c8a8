#ifndef LIGHT_FIELD_DEPTH_IO_CLOUD_FILES_H
#define LIGHT_FIELD_DEPTH_IO_CLOUD_FILES_H

#include <cstddef>
#include <filesystem>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/point_cloud.h"

namespace light_field_depth
{
/// The axes of the points in a file.
enum class CloudAxes
{
  Optical,  ///< x to the right, y downwards, z away from the camera, as in ROS's optical frames
  YUp       ///< x to the right, y upwards, z towards the viewer, as in Blender's and OpenGL's cameras
};

/// Writes a binary PLY with x y z in metres and red green blue; the file appears whole or not at all. Points
/// that are not finite are left out. The file has vertices alone, which every reader understands.
/// @return the number of points written; where no point is finite, no file is written
/// @throw InputError if the file cannot be written
std::size_t writePly(const std::filesystem::path& path, const std::vector<ColoredPoint>& points,
                     CloudAxes axes = CloudAxes::Optical);

/// The positions of the vertices of a binary little-endian PLY, in the order of the file. Other properties
/// and elements are passed over.
/// @throw InputError if the file cannot be read, or has no vertices with x, y and z as float or double
std::vector<cv::Point3f> readPlyPositions(const std::filesystem::path& path);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_CLOUD_FILES_H
