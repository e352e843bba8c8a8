#include "light_field_depth/io/cloud_files.h"

#include <cmath>
#include <exception>

#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
pcl::PointCloud<pcl::PointXYZRGB> finitePoints(const std::vector<ColoredPoint>& points)
{
  pcl::PointCloud<pcl::PointXYZRGB> cloud;
  cloud.reserve(points.size());
  for (const ColoredPoint& point : points)
  {
    if (std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z))
    {
      pcl::PointXYZRGB colored;
      colored.x = point.x;
      colored.y = point.y;
      colored.z = point.z;
      colored.r = point.r;
      colored.g = point.g;
      colored.b = point.b;
      cloud.push_back(colored);
    }
  }
  return cloud;
}

}  // namespace

std::size_t writePly(const std::filesystem::path& path, const std::vector<ColoredPoint>& points)
{
  const pcl::PointCloud<pcl::PointXYZRGB> cloud = finitePoints(points);
  if (cloud.empty())
  {
    return 0;  // PCL refuses to write a file without points
  }
  writeWhole(path,
             [&](const std::filesystem::path& temporary)
             {
               int status = -1;
               try
               {
                 status = pcl::io::savePLYFileBinary(temporary.string(), cloud);
               }
               catch (const std::exception&)
               {
                 status = -1;
               }
               if (status != 0)
               {
                 throw InputError("The cloud '" + path.string() +
                                  "' cannot be written; check the folder, its permissions and the disk.");
               }
             });
  return cloud.size();
}

}  // namespace light_field_depth
