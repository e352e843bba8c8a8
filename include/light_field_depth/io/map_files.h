#ifndef LIGHT_FIELD_DEPTH_IO_MAP_FILES_H
#define LIGHT_FIELD_DEPTH_IO_MAP_FILES_H

#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// A file format of a map of floats.
enum class MapFormat
{
  Pfm,   ///< portable float map
  Npy,   ///< NumPy: float32, rows x columns
  Exr,   ///< OpenEXR, one channel of float
  Png16  ///< 16-bit PNG of scaled values, 0 where unknown
};

/// "pfm", "npy", "exr", "png16". @throw InputError that lists the names
MapFormat mapFormatFromString(const std::string& name);
/// The formats of a list with commas, each once. @throw InputError
std::vector<MapFormat> mapFormatsFromString(const std::string& list);

/// level = round((value - offset) * scale), 1 .. 65535; 0 is unknown.
struct Png16Scale
{
  double scale = 1.0;   ///< levels per unit of the map
  double offset = 0.0;  ///< value of level 0
};

/// 256 levels a pixel as in the KITTI benchmark, fewer if the values do not fit. The offset is 0 where no
/// value is negative, else a whole number below all of them.
Png16Scale disparityPng16Scale(const cv::Mat& disparity);
/// Millimetres, as depth cameras have them.
Png16Scale depthPng16Scale();
/// 0 .. 1 becomes 1 .. 65535.
Png16Scale confidencePng16Scale();

/// Writes a map in one format; the file appears whole or not at all.
/// @param path without an ending
/// @param values CV_32FC1, not empty
/// @return the file's name @throw InputError if the file cannot be written
std::string writeMap(const std::filesystem::path& path, const cv::Mat& values, MapFormat format,
                     const Png16Scale& png16);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_MAP_FILES_H
