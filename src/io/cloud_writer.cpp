#include "light_field_depth/io/cloud_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "io/posix_files.h"
#include "light_field_depth/core/enum_names.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
constexpr EnumNames<CloudFormat, 2> FORMAT_NAMES = {{{CloudFormat::Ply, "ply"}, {CloudFormat::Pcd, "pcd"}}};

/// Points of one block: as much as a cache holds. 20 M points take 0.3 s of processor time, 0.9 s in blocks
/// of 8 MB.
constexpr std::size_t BLOCK_POINTS = 4096;
/// Characters of the headers, whatever the number of points: the number is known last.
constexpr std::size_t HEADER_BYTES = 512;
constexpr std::size_t PLY_POINT_BYTES = 32;
constexpr std::size_t PCD_POINT_BYTES = 33;

void put(float value, char*& bytes)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  for (int shift = 0; shift < 32; shift += 8)
  {
    *bytes++ = static_cast<char>(bits >> shift & 0xFFU);
  }
}

void put(std::uint8_t value, char*& bytes)
{
  *bytes++ = static_cast<char>(value);
}

/// @param padding characters of a comment that make up for the digits of the number
std::string plyHeader(std::size_t points, std::size_t padding)
{
  return "ply\nformat binary_little_endian 1.0\ncomment positions in metres; views: maps that "
         "agree\ncomment " +
         std::string(padding, '-') + "\nelement vertex " + std::to_string(points) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
         "property float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar "
         "views\n"
         "property float confidence\nend_header\n";
}

std::string pcdHeader(std::size_t points, std::size_t padding)
{
  const std::string count = std::to_string(points);
  return "# .PCD v0.7 - Point Cloud Data file format\n# " + std::string(padding, '-') +
         "\nVERSION 0.7\nFIELDS x y z normal_x normal_y normal_z rgb confidence views\nSIZE 4 4 4 4 4 4 4 4 "
         "1\n"
         "TYPE F F F F F F F F U\nCOUNT 1 1 1 1 1 1 1 1 1\nWIDTH " +
         count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
}

std::string headerOf(CloudFormat format, std::size_t points)
{
  const auto make = format == CloudFormat::Ply ? plyHeader : pcdHeader;
  return make(points, HEADER_BYTES - make(points, 0).size());
}

void encode(const DensePoint& point, CloudFormat format, float sign, char*& bytes)
{
  for (const float value : {point.x, sign * point.y, sign * point.z, point.normal_x, sign * point.normal_y,
                            sign * point.normal_z})
  {
    put(value, bytes);
  }
  if (format == CloudFormat::Ply)
  {
    for (const std::uint8_t value : {point.r, point.g, point.b, point.views})
    {
      put(value, bytes);
    }
    put(point.confidence, bytes);
    return;
  }
  // A float by name only: its bytes are b, g, r, 0.
  for (const std::uint8_t value : {point.b, point.g, point.r, std::uint8_t{0}})
  {
    put(value, bytes);
  }
  put(point.confidence, bytes);
  put(point.views, bytes);
}

}  // namespace

std::string toString(CloudFormat format)
{
  return enumName(FORMAT_NAMES, format);
}

CloudFormat cloudFormatFromString(const std::string& name)
{
  return enumValue(FORMAT_NAMES, name, "format of clouds");
}

class CloudWriter::File
{
public:
  File(const std::filesystem::path& path, CloudFormat format, CloudAxes axes)
      : target_(path), pending_(path),
        file_(std::make_unique<Descriptor>(open(pending_.path().c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC))),
        format_(format), sign_(axes == CloudAxes::YUp ? -1.0F : 1.0F)
  {
    const std::string header = headerOf(format_, 0);
    append(header.data(), header.size());
  }

  void write(const DensePoint* points, std::size_t count)
  {
    points_ += count;
    const bool as_it_is = isLikeInMemory();
    for (std::size_t first = 0; first < count; first += BLOCK_POINTS)
    {
      if (as_it_is)
      {
        append(reinterpret_cast<const char*>(points + first),
               std::min(BLOCK_POINTS, count - first) * sizeof(DensePoint));
        continue;
      }
      char* end = block_.data();
      for (std::size_t i = first; i < std::min(first + BLOCK_POINTS, count); ++i)
      {
        encode(points[i], format_, sign_, end);
      }
      append(block_.data(), static_cast<std::size_t>(end - block_.data()));
    }
  }

  std::size_t finish()
  {
    if (points_ > 0)
    {
      const std::string header = headerOf(format_, points_);
      if (lseek(file_->number(), 0, SEEK_SET) != 0)
      {
        fail();
      }
      append(header.data(), header.size());
      file_.reset();
      pending_.commit();
    }
    return points_;
  }

private:
  /// A point of a PLY is what a DensePoint is, where numbers have their lowest byte first.
  bool isLikeInMemory() const
  {
    static_assert(offsetof(DensePoint, normal_x) == 12 && offsetof(DensePoint, r) == 24 &&
                      offsetof(DensePoint, views) == 27 && offsetof(DensePoint, confidence) == 28,
                  "x y z nx ny nz r g b views confidence");
    const std::uint16_t one = 1;
    std::uint8_t first_byte = 0;
    std::memcpy(&first_byte, &one, 1);
    return format_ == CloudFormat::Ply && sign_ > 0.0F && first_byte == 1;
  }

  void append(const char* bytes, std::size_t size)
  {
    for (std::size_t done = 0; done < size;)
    {
      const ssize_t count = ::write(file_->number(), bytes + done, size - done);
      if (count < 0 && errno != EINTR)
      {
        fail();
      }
      done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    }
  }

  [[noreturn]] void fail() const
  {
    throw InputError("'" + target_.string() + "' cannot be written: " + systemError(errno) +
                     "; check the folder's permissions and the space on the disk.");
  }

  std::filesystem::path target_;
  PendingFile pending_;
  std::unique_ptr<Descriptor> file_;
  CloudFormat format_;
  float sign_;
  std::size_t points_ = 0;
  std::array<char, BLOCK_POINTS * std::max(PLY_POINT_BYTES, PCD_POINT_BYTES)> block_{};
};

CloudWriter::CloudWriter(const std::filesystem::path& path, CloudFormat format, CloudAxes axes)
    : file_(std::make_unique<File>(path, format, axes))
{
}

CloudWriter::~CloudWriter() = default;

void CloudWriter::write(const DensePoint* points, std::size_t count)
{
  file_->write(points, count);
}

std::size_t CloudWriter::finish()
{
  return file_->finish();
}

}  // namespace light_field_depth
