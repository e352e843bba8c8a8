#ifndef LIGHT_FIELD_DEPTH_IO_CLOUD_WRITER_H
#define LIGHT_FIELD_DEPTH_IO_CLOUD_WRITER_H

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "light_field_depth/core/point_cloud.h"
#include "light_field_depth/io/cloud_files.h"

namespace light_field_depth
{
/// How points lie in a file.
enum class CloudFormat
{
  Ply,  ///< binary PLY of vertices: x y z nx ny nz (float), red green blue views (uchar), confidence (float)
  Pcd   ///< binary PCD: x y z normal_x normal_y normal_z rgb confidence (float), views (uchar)
};

/// "ply", "pcd": the names, and the extensions of the files.
std::string toString(CloudFormat format);
/// The inverse of toString(). @throw InputError that lists the names
CloudFormat cloudFormatFromString(const std::string& name);

/// Writes a cloud block after block, in memory that does not grow with it. The file is there, whole and
/// synced, once finish() has returned, and never in part. Positions are metres. Not thread-safe.
class CloudWriter
{
public:
  /// @throw InputError if there can be no such file
  CloudWriter(const std::filesystem::path& path, CloudFormat format, CloudAxes axes = CloudAxes::Optical);
  ~CloudWriter();
  CloudWriter(const CloudWriter&) = delete;
  CloudWriter& operator=(const CloudWriter&) = delete;

  /// @throw InputError if the disk is full or the like
  void write(const DensePoint* points, std::size_t count);

  /// Once, after all points. Where there are none, no file is written. @return the number of points
  std::size_t finish();

private:
  class File;
  std::unique_ptr<File> file_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_CLOUD_WRITER_H
