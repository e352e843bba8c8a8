#ifndef LIGHT_FIELD_DEPTH_IO_CLOUD_FILES_H
#define LIGHT_FIELD_DEPTH_IO_CLOUD_FILES_H

#include <cstddef>
#include <filesystem>
#include <vector>

#include "light_field_depth/core/point_cloud.h"

namespace light_field_depth
{
/// Writes a binary PLY with x y z in metres and red green blue; the file appears whole or not at all. Points
/// that are not finite are left out.
/// @return the number of points written; where no point is finite, no file is written
/// @throw InputError if the file cannot be written
std::size_t writePly(const std::filesystem::path& path, const std::vector<ColoredPoint>& points);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_CLOUD_FILES_H
