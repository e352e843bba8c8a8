#include "light_field_depth/io/map_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <utility>

#include "io/little_endian.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/io/image_files.h"
#include "light_field_depth/io/pfm.h"

namespace light_field_depth
{
namespace
{
constexpr double MAX_LEVEL = 65535.0;    // of 16 bits
constexpr double LEVELS_PER_PX = 256.0;  // as KITTI has disparities
constexpr double LEVELS_PER_M = 1000.0;  // as depth cameras have millimetres (REP 118)
/// The header of a .npy file ends at a multiple of this.
constexpr std::size_t NPY_ALIGNMENT = 64;
constexpr std::size_t NPY_PREAMBLE = 10;

constexpr std::array<std::pair<MapFormat, const char*>, 4> FORMATS = {{
    {MapFormat::Pfm, "pfm"},
    {MapFormat::Npy, "npy"},
    {MapFormat::Exr, "exr"},
    {MapFormat::Png16, "png16"},
}};

std::string npyText(const cv::Mat& values)
{
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(values.rows) +
                       ", " + std::to_string(values.cols) + "), }";
  while ((NPY_PREAMBLE + header.size() + 1) % NPY_ALIGNMENT != 0)
  {
    header += ' ';
  }
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += '\x01';
  bytes += '\x00';
  bytes += static_cast<char>(header.size() & 0xFFU);
  bytes += static_cast<char>(header.size() >> 8U);
  bytes += header;
  for (int y = 0; y < values.rows; ++y)
  {
    for (int x = 0; x < values.cols; ++x)
    {
      appendLittleEndian(bytes, values.at<float>(y, x));
    }
  }
  return bytes;
}

cv::Mat png16Levels(const cv::Mat& values, const Png16Scale& scale)
{
  cv::Mat levels(values.size(), CV_16UC1);
  for (int y = 0; y < values.rows; ++y)
  {
    for (int x = 0; x < values.cols; ++x)
    {
      const double level = std::round((values.at<float>(y, x) - scale.offset) * scale.scale);
      // What is unknown, or beyond what 16 bits hold, is 0; the smallest known value is 1.
      const bool is_known = std::isfinite(level) && level >= 0.0 && level <= MAX_LEVEL;
      levels.at<std::uint16_t>(y, x) = is_known ? static_cast<std::uint16_t>(std::max(level, 1.0)) : 0;
    }
  }
  return levels;
}

}  // namespace

MapFormat mapFormatFromString(const std::string& name)
{
  const auto* const found =
      std::find_if(FORMATS.begin(), FORMATS.end(), [&](const auto& entry) { return name == entry.second; });
  if (found == FORMATS.end())
  {
    throw InputError("There is no format '" + name + "' of maps; choose pfm, npy, exr or png16.");
  }
  return found->first;
}

std::vector<MapFormat> mapFormatsFromString(const std::string& list)
{
  std::vector<MapFormat> formats;
  std::istringstream stream(list);
  for (std::string name; std::getline(stream, name, ',');)
  {
    const MapFormat format = mapFormatFromString(name);
    if (std::find(formats.begin(), formats.end(), format) == formats.end())
    {
      formats.push_back(format);
    }
  }
  if (formats.empty())
  {
    mapFormatFromString(list);
  }
  return formats;
}

Png16Scale disparityPng16Scale(const cv::Mat& disparity)
{
  double least = 0.0;
  double most = 0.0;
  for (int y = 0; y < disparity.rows; ++y)
  {
    for (int x = 0; x < disparity.cols; ++x)
    {
      const double value = disparity.at<float>(y, x);
      if (std::isfinite(value))
      {
        least = std::min(least, value);
        most = std::max(most, value);
      }
    }
  }
  const double offset = least < 0.0 ? std::floor(least) - 1.0 : 0.0;
  double scale = LEVELS_PER_PX;
  while ((most - offset) * scale > MAX_LEVEL)
  {
    scale *= 0.5;
  }
  return {scale, offset};
}

Png16Scale depthPng16Scale()
{
  return {LEVELS_PER_M, 0.0};
}

Png16Scale confidencePng16Scale()
{
  return {MAX_LEVEL, 0.0};
}

std::string writeMap(const std::filesystem::path& path, const cv::Mat& values, MapFormat format,
                     const Png16Scale& png16)
{
  const auto with = [&](const std::string& ending) { return std::filesystem::path(path.string() + ending); };
  switch (format)
  {
    case MapFormat::Npy:
      writeFile(with(".npy"), npyText(values));
      return with(".npy").filename().string();
    case MapFormat::Exr:
      writeImage(with(".exr"), values);
      return with(".exr").filename().string();
    case MapFormat::Png16:
      writeImage(with("_16.png"), png16Levels(values, png16));
      return with("_16.png").filename().string();
    case MapFormat::Pfm:
      break;
  }
  writePfm(with(".pfm"), values);
  return with(".pfm").filename().string();
}

}  // namespace light_field_depth
