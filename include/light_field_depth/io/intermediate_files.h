#ifndef LIGHT_FIELD_DEPTH_IO_INTERMEDIATE_FILES_H
#define LIGHT_FIELD_DEPTH_IO_INTERMEDIATE_FILES_H

#include <filesystem>
#include <string>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// Writes an intermediate result into a folder, which is created if need be: 8 and 16 bit images of one or
/// three channels as NAME.png, everything else as NAME.pfm, converted to single precision, one file
/// NAME_<channel>.pfm for each of several channels. Empty matrices are left out.
/// @throw InputError if the file cannot be written
void writeIntermediate(const std::filesystem::path& folder, const std::string& name, const cv::Mat& values);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_INTERMEDIATE_FILES_H
