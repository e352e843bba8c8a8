#ifndef LIGHT_FIELD_DEPTH_IO_IMAGE_FILES_H
#define LIGHT_FIELD_DEPTH_IO_IMAGE_FILES_H

#include <filesystem>
#include <string>

#include <opencv2/core.hpp>

#include "light_field_depth/core/input_limits.h"

namespace light_field_depth
{
/// Whether a file's extension is one of the image formats that are read, in upper or lower case: PNG,
/// JPEG, TIFF, BMP, PGM and PPM, WebP, OpenEXR.
bool isImageFile(const std::filesystem::path& path);

/// "PNG, JPEG, TIFF, BMP, PGM, PPM, WebP or EXR", for messages.
std::string imageFormatsText();

/// Reads a whole image without changing its values: CV_8U, CV_16U, or CV_32F for linear floats, grey or BGR;
/// an alpha channel is left out, a palette and CMYK become BGR, and an orientation tag turns the image
/// upright. Thread safe.
/// @param mask becomes the mask that the alpha channel of a PNG makes (core/mask_sources.h); empty where
/// there is none
/// @param max_megapixels of the image; a larger PNG, JPEG, BMP, PGM or PPM is refused before it is decoded
/// @throw InputError if the file cannot be read, is truncated or damaged, has values of another kind or is
/// too large
cv::Mat readImage(const std::filesystem::path& path, cv::Mat* mask = nullptr,
                  double max_megapixels = InputLimits().megapixels);

/// Writes an image in the format that the extension names; the file appears whole or not at all.
/// @throw InputError if the file cannot be written
void writeImage(const std::filesystem::path& path, const cv::Mat& image);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_IMAGE_FILES_H
