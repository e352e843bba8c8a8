#ifndef LIGHT_FIELD_DEPTH_IO_PFM_H
#define LIGHT_FIELD_DEPTH_IO_PFM_H

#include <filesystem>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// Reads a portable float map of one channel ("Pf"), of either byte order. The scale of the header gives the
/// byte order only; values are not multiplied by it.
/// @return CV_32FC1, first row on top
/// @throw InputError if the file cannot be read, is not a PFM of one channel, or does not hold exactly the
///   width x height values that its header announces
cv::Mat readPfm(const std::filesystem::path& path);

/// Writes a little-endian portable float map; the file appears whole or not at all.
/// @param values CV_32FC1, not empty
/// @throw InputError if the file cannot be written
void writePfm(const std::filesystem::path& path, const cv::Mat& values);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_PFM_H
