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

TEST(FormatMiddlebury, TakesItsCalibration)
{
  const TemporaryFolder folder;
  const std::string calib =
      "cam0=[100 0 41; 0 100 31.5; 0 0 1]\ncam1=[100 0 43.5; 0 100 31.5; 0 0 1]\ndoffs=2.5\nbaseline=200\n"
      "width=80\nheight=64\nndisp=12\n";
  folder.write("calib.txt", calib);
  testing::write(folder, "im0.png", testing::RenderedScene::view(0, 0));
  testing::write(folder, "im1.png", testing::RenderedScene::view(0, 1));
  const Dataset dataset = readDataset(folder.path());
  EXPECT_EQ(dataset.place_claim, PlaceClaim::Stated);
  ASSERT_TRUE(dataset.light_field.calibration);
  const Calibration& calibration = *dataset.light_field.calibration;
  EXPECT_DOUBLE_EQ(calibration.focal_length_px, 100.0);
  EXPECT_DOUBLE_EQ(calibration.baseline_m, 0.2);
  EXPECT_DOUBLE_EQ(calibration.disparity_offset_px, 2.5);
  EXPECT_EQ(calibration.principal_point_px, cv::Point2d(41.0, 31.5));
  ASSERT_TRUE(dataset.disparity_range);
  EXPECT_EQ(dataset.disparity_range->max, 12.0F);
}

}  // namespace
}  // namespace light_field_depth
