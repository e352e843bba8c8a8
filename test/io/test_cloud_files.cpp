#include "light_field_depth/io/cloud_files.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

TEST(CloudFiles, RoundTripLeavesOutWhatIsUnknown)
{
  const TemporaryFolder folder;
  const std::vector<ColoredPoint> points = {{1.0F, -2.0F, 3.5F, 10, 20, 30, 0, 1.0F},
                                            {NaN, NaN, NaN, 1, 2, 3, 0, 0.0F},
                                            {0.25F, 0.5F, 9.0F, 255, 0, 128, 0, 0.5F}};
  EXPECT_EQ(writePly(folder / "cloud.ply", points), 2U);
  pcl::PointCloud<pcl::PointXYZRGB> cloud;
  ASSERT_EQ(pcl::io::loadPLYFile((folder / "cloud.ply").string(), cloud), 0);
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud[0].x, 1.0F);
  EXPECT_EQ(cloud[0].y, -2.0F);
  EXPECT_EQ(cloud[0].z, 3.5F);
  EXPECT_EQ(cloud[0].b, 10);
  EXPECT_EQ(cloud[0].g, 20);
  EXPECT_EQ(cloud[0].r, 30);
  EXPECT_EQ(cloud[1].b, 255);
  EXPECT_EQ(cloud[1].r, 128);
  EXPECT_EQ(folder.fileCount(), 1U);
}

TEST(CloudFiles, WritesNoFileWithoutPointsAndSaysWhereItCannotWrite)
{
  const TemporaryFolder folder;
  EXPECT_EQ(writePly(folder / "cloud.ply", {{NaN, NaN, NaN, 0, 0, 0, 0, 0}}), 0U);
  EXPECT_EQ(folder.fileCount(), 0U);
  EXPECT_THROW(writePly(folder / "absent/cloud.ply", {{1, 1, 1, 0, 0, 0, 0, 0}}), InputError);
}

TEST(CloudFiles, HaveVerticesAloneAndTurnTheirAxesOnRequest)
{
  const TemporaryFolder folder;
  const std::vector<ColoredPoint> points = {{1.0F, -2.0F, 3.5F, 10, 20, 30, 0, 1.0F}};
  for (const auto& [axes, y] :
       {std::make_pair(CloudAxes::Optical, -2.0F), std::make_pair(CloudAxes::YUp, 2.0F)})
  {
    writePly(folder / "cloud.ply", points, axes);
    const std::string bytes = readFile(folder / "cloud.ply");
    EXPECT_EQ(bytes.find("element camera"), std::string::npos);
    EXPECT_NE(bytes.find("element vertex 1\n"), std::string::npos);
    const std::size_t body = bytes.find("end_header\n") + 11;
    ASSERT_EQ(bytes.size(), body + 15);
    float read = 0.0F;
    std::copy_n(bytes.data() + body + 4, 4, reinterpret_cast<char*>(&read));
    EXPECT_EQ(read, y);
  }
}

}  // namespace
}  // namespace light_field_depth
