#include <gtest/gtest.h>

#include <string>

#include "io/scene_folders.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/dataset.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

TEST(FormatKitti, TakesItsCalibration)
{
  const TemporaryFolder folder;
  for (const char* const camera : {"image_0", "image_1"})
  {
    testing::write(folder, camera + std::string("/000000.png"), cv::Mat(20, 24, CV_8UC1, 100.0));
  }
  folder.write("calib.txt", "P0: 700 0 11 0 0 700 9 0 0 0 1 0\nP1: 700 0 11 -378 0 700 9 0 0 0 1 0\n");
  const Dataset dataset = readDataset(folder.path());
  ASSERT_TRUE(dataset.light_field.calibration);
  EXPECT_DOUBLE_EQ(dataset.light_field.calibration->focal_length_px, 700.0);
  EXPECT_DOUBLE_EQ(dataset.light_field.calibration->baseline_m, 0.54);
  EXPECT_EQ(dataset.light_field.calibration->principal_point_px, cv::Point2d(11.0, 9.0));
}

}  // namespace
}  // namespace light_field_depth
