// Clouds that are written in blocks, read back by PCL and by a reader that knows PLY's text alone.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/cloud_files.h"
#include "light_field_depth/io/cloud_writer.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

/// More than one block.
constexpr std::size_t POINTS = 10000;

std::vector<DensePoint> points()
{
  std::vector<DensePoint> made;
  for (std::size_t i = 0; i < POINTS; ++i)
  {
    const auto value = static_cast<float>(i);
    made.push_back({value, -value, 1.0F + value, 0.6F, 0.0F, -0.8F, static_cast<std::uint8_t>(i % 256), 20,
                    30, static_cast<std::uint8_t>(i % 5 + 1), 0.25F});
  }
  return made;
}

std::size_t write(const std::filesystem::path& path, CloudFormat format, CloudAxes axes = CloudAxes::Optical)
{
  const std::vector<DensePoint> made = points();
  CloudWriter writer(path, format, axes);
  writer.write(made.data(), 1);
  writer.write(made.data() + 1, made.size() - 1);
  return writer.finish();
}

void expectPoint(const pcl::PointXYZRGBNormal& point, std::size_t i)
{
  const auto value = static_cast<float>(i);
  EXPECT_EQ(point.x, value);
  EXPECT_EQ(point.y, -value);
  EXPECT_EQ(point.z, 1.0F + value);
  EXPECT_EQ(point.normal_x, 0.6F);
  EXPECT_EQ(point.normal_z, -0.8F);
  EXPECT_EQ(point.r, i % 256);
  EXPECT_EQ(point.g, 20);
  EXPECT_EQ(point.b, 30);
}

TEST(CloudWriter, WritesPlyThatPclReads)
{
  const TemporaryFolder folder;
  EXPECT_EQ(write(folder / "cloud.ply", CloudFormat::Ply), POINTS);
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud;
  ASSERT_EQ(pcl::io::loadPLYFile((folder / "cloud.ply").string(), cloud), 0);
  ASSERT_EQ(cloud.size(), POINTS);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{4096}, POINTS - 1})
  {
    expectPoint(cloud[i], i);
  }
}

TEST(CloudWriter, WritesPcdThatPclReads)
{
  const TemporaryFolder folder;
  EXPECT_EQ(write(folder / "cloud.pcd", CloudFormat::Pcd), POINTS);
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile((folder / "cloud.pcd").string(), cloud), 0);
  ASSERT_EQ(cloud.size(), POINTS);
  for (const std::size_t i : {std::size_t{0}, std::size_t{4096}, POINTS - 1})
  {
    expectPoint(cloud[i], i);
  }
}

TEST(CloudWriter, WritesPlyThatOtherReadersUnderstand)
{
  const TemporaryFolder folder;
  write(folder / "cloud.ply", CloudFormat::Ply, CloudAxes::YUp);
  const std::vector<cv::Point3f> positions = readPlyPositions(folder / "cloud.ply");
  ASSERT_EQ(positions.size(), POINTS);
  EXPECT_EQ(positions[7], cv::Point3f(7.0F, 7.0F, -8.0F));
  folder.write("read.py", R"(
import struct, sys
types = {'float': 'f', 'uchar': 'B'}
data = open(sys.argv[1], 'rb').read()
head, body = data.split(b'end_header\n', 1)
elements, form, names = [], '<', []
for line in head.decode('ascii').splitlines():
    words = line.split()
    if words[0] == 'element':
        elements.append((words[1], int(words[2])))
    elif words[0] == 'property':
        form += types[words[1]]
        names.append(words[2])
assert [name for name, _ in elements] == ['vertex'], elements
assert len(body) == elements[0][1] * struct.calcsize(form)
point = dict(zip(names, struct.unpack_from(form, body, 9999 * struct.calcsize(form))))
print(elements[0][1], point['x'], point['nz'], point['red'], point['blue'], point['views'], point['confidence'])
)");
  if (testing::runProgram("/usr/bin/python3 -c 'import struct'").exit_code != 0)
  {
    GTEST_SKIP() << "there is no Python here";
  }
  const testing::Outcome outcome =
      testing::runProgram("/usr/bin/python3 " + testing::quoted((folder / "read.py").string()) + " " +
                          testing::quoted((folder / "cloud.ply").string()));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, "10000 9999.0 0.800000011920929 15 30 5 0.25\n");
}

TEST(CloudWriter, WritesNothingForNoPointsAndSaysWhatIsWrong)
{
  const TemporaryFolder folder;
  {
    CloudWriter writer(folder / "empty.ply", CloudFormat::Ply);
    EXPECT_EQ(writer.finish(), 0U);
    CloudWriter unfinished(folder / "unfinished.ply", CloudFormat::Ply);
    unfinished.write(points().data(), 5);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THROW(CloudWriter(folder / "absent/cloud.ply", CloudFormat::Ply), InputError);
  EXPECT_THROW(cloudFormatFromString("obj"), InputError);
  folder.write("text.ply", "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n");
  folder.write("short.ply",
               "ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty float x\nproperty float "
               "y\nproperty float z\nend_header\n");
  folder.write("flat.ply",
               "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\nend_header\n");
  for (const char* const name : {"text.ply", "short.ply", "flat.ply", "none.ply"})
  {
    EXPECT_THROW(readPlyPositions(folder / name), InputError) << name;
  }
}

}  // namespace
}  // namespace light_field_depth
