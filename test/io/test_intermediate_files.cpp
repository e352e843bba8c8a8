#include "light_field_depth/io/intermediate_files.h"

#include <cstdint>
#include <filesystem>

#include <gtest/gtest.h>

#include "light_field_depth/io/image_files.h"
#include "light_field_depth/io/pfm.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

TEST(IntermediateFiles, ChoosesTheFormatByTheType)
{
  const TemporaryFolder folder;
  const auto target = folder / "intermediate";
  writeIntermediate(target, "grey", cv::Mat(4, 5, CV_8UC1, cv::Scalar(7)));
  writeIntermediate(target, "wide", cv::Mat(4, 5, CV_16UC3, cv::Scalar(700, 800, 900)));
  writeIntermediate(target, "map", cv::Mat(4, 5, CV_32FC1, cv::Scalar(0.125)));
  writeIntermediate(target, "flow", cv::Mat(4, 5, CV_32FC2, cv::Scalar(1.5, -2.5)));
  writeIntermediate(target, "labels", cv::Mat(4, 5, CV_32SC1, cv::Scalar(-3)));
  writeIntermediate(target, "empty", cv::Mat());
  EXPECT_EQ(readImage(target / "grey.png").at<std::uint8_t>(3, 4), 7);
  EXPECT_EQ(readImage(target / "wide.png").at<cv::Vec3w>(3, 4), cv::Vec3w(700, 800, 900));
  EXPECT_EQ(readPfm(target / "map.pfm").at<float>(0, 0), 0.125F);
  EXPECT_EQ(readPfm(target / "flow_0.pfm").at<float>(0, 0), 1.5F);
  EXPECT_EQ(readPfm(target / "flow_1.pfm").at<float>(0, 0), -2.5F);
  EXPECT_EQ(readPfm(target / "labels.pfm").at<float>(0, 0), -3.0F);
  EXPECT_FALSE(std::filesystem::exists(target / "empty.pfm"));
}

}  // namespace
}  // namespace light_field_depth
