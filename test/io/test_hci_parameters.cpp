#include <gtest/gtest.h>

#include <string>

#include "io/folder_description.h"
#include "light_field_depth/core/error.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
FolderDescription described(const std::string& text)
{
  const testing::TemporaryFolder folder;
  folder.write("parameters.cfg", text);
  FolderDescription description;
  description.grid = cv::Rect(0, 0, 9, 9);
  readHciParameters(folder / "parameters.cfg", description);
  return description;
}

std::string complaint(const std::string& text)
{
  return testing::messageOf<InputError>([&] { described(text); });
}

TEST(HciParameters, MillimetresBecomeMetresAndTheFocalLengthASharesOfTheSensor)
{
  const FolderDescription description = described(
      "[intrinsics]\nfocal_length_mm = 100.0\nsensor_size_mm = 35\n"
      "[extrinsics]\nnum_cams_x = 5\nnum_cams_y = 7\nbaseline_mm = 50\nfocus_distance_m = 8\n"
      "[meta]\ndisp_min = -1.5\ndisp_max = 1.5\n");
  ASSERT_TRUE(description.grid);
  EXPECT_EQ(*description.grid, cv::Rect(0, 0, 5, 7));
  ASSERT_TRUE(description.camera);
  EXPECT_DOUBLE_EQ(description.camera->focal_length_per_side, 100.0 / 35.0);
  EXPECT_DOUBLE_EQ(description.camera->baseline_m, 0.05);
  ASSERT_TRUE(description.camera->focus_distance_m);
  EXPECT_DOUBLE_EQ(*description.camera->focus_distance_m, 8.0);
  ASSERT_TRUE(description.disparity_range);
  EXPECT_EQ(description.disparity_range->min, -1.5F);
}

TEST(HciParameters, WhatIsNotThereStaysAsItWas)
{
  const FolderDescription description = described("[meta]\nscene = cotton\n");
  EXPECT_EQ(*description.grid, cv::Rect(0, 0, 9, 9));
  EXPECT_FALSE(description.camera);
  EXPECT_FALSE(description.disparity_range);
}

TEST(HciParameters, ComplaintsNameTheField)
{
  EXPECT_NE(complaint("[extrinsics]\nnum_cams_x = 2.5\n").find("extrinsics.num_cams_x is '2.5"),
            std::string::npos);
  EXPECT_NE(complaint("[intrinsics]\nfocal_length_mm = long\n").find("it must be a number"),
            std::string::npos);
  EXPECT_NE(complaint("[intrinsics]\nsensor_size_mm = -35\n").find("a positive number"), std::string::npos);
  EXPECT_NE(complaint("[extrinsics\n").find("line 1"), std::string::npos);
}

}  // namespace
}  // namespace light_field_depth
