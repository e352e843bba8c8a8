#include "light_field_depth/io/cloud_files.h"

#include <cmath>
#include <cstdint>
#include <string>

#include "io/little_endian.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
bool isFinite(const ColoredPoint& point)
{
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

std::string header(std::size_t points)
{
  return "ply\nformat binary_little_endian 1.0\ncomment metres\nelement vertex " + std::to_string(points) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
         "property uchar blue\nend_header\n";
}

}  // namespace

std::size_t writePly(const std::filesystem::path& path, const std::vector<ColoredPoint>& points,
                     CloudAxes axes)
{
  const float sign = axes == CloudAxes::YUp ? -1.0F : 1.0F;
  std::string body;
  std::size_t count = 0;
  for (const ColoredPoint& point : points)
  {
    if (!isFinite(point))
    {
      continue;
    }
    ++count;
    appendLittleEndian(body, point.x);
    appendLittleEndian(body, sign * point.y);
    appendLittleEndian(body, sign * point.z);
    for (const std::uint8_t level : {point.r, point.g, point.b})
    {
      body += static_cast<char>(level);
    }
  }
  if (count > 0)
  {
    writeFile(path, header(count) + body);
  }
  return count;
}

}  // namespace light_field_depth
