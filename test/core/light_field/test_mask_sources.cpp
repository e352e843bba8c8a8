#include "light_field_depth/core/mask_sources.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
const cv::Size SIZE(20, 16);

int masked(const cv::Mat& mask)
{
  return mask.empty() ? 0 : static_cast<int>(mask.total()) - cv::countNonZero(mask);
}

TEST(MaskSources, BlackUpToTheBorderIsMaskedWithAPixelMore)
{
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC1, CV_16UC3})
  {
    cv::Mat image(SIZE, type, cv::Scalar::all(90.0));
    EXPECT_TRUE(blackMask(image).empty()) << "nothing black";
    image({8, 6, 3, 3}).setTo(cv::Scalar::all(0.0));
    EXPECT_TRUE(blackMask(image).empty()) << "a dark object";
    image({0, 0, 4, 16}).setTo(cv::Scalar::all(0.0));
    const cv::Mat mask = blackMask(image);
    ASSERT_EQ(mask.size(), SIZE);
    EXPECT_EQ(masked(mask), 5 * 16);
    EXPECT_EQ(cv::countNonZero(mask.colRange(0, 5)), 0);
  }
}

TEST(MaskSources, BlackLeavesRoomForJpegButNotForColours)
{
  cv::Mat image(SIZE, CV_8UC3, cv::Scalar(90, 80, 70));
  image.colRange(0, 4).setTo(cv::Scalar(4, 3, 0));
  EXPECT_EQ(masked(blackMask(image)), 5 * 16);
  image.colRange(0, 4).setTo(cv::Scalar(0, 0, 5));
  EXPECT_TRUE(blackMask(image).empty());
}

TEST(MaskSources, AlphaMasksWhereItIsZeroUnlessNobodyWroteIt)
{
  for (const int type : {CV_8UC4, CV_16UC4})
  {
    cv::Mat image(SIZE, type, cv::Scalar(1, 2, 3, 200));
    EXPECT_TRUE(alphaMask(image).empty());
    image.row(3).setTo(cv::Scalar(1, 2, 3, 0));
    EXPECT_EQ(masked(alphaMask(image)), SIZE.width);
    image.setTo(cv::Scalar(1, 2, 3, 0));
    EXPECT_TRUE(alphaMask(image).empty());
  }
  EXPECT_TRUE(alphaMask(cv::Mat::zeros(SIZE, CV_8UC3)).empty());
}

TEST(MaskSources, BothMasksCount)
{
  cv::Mat a(SIZE, CV_8UC1, cv::Scalar(255));
  cv::Mat b(SIZE, CV_8UC1, cv::Scalar(1));
  a.row(0).setTo(0);
  b.row(1).setTo(0);
  EXPECT_EQ(masked(bothKnown(a, b)), 2 * SIZE.width);
  EXPECT_EQ(bothKnown(a, {}).data, a.data);
  EXPECT_EQ(bothKnown({}, b).data, b.data);
  EXPECT_TRUE(bothKnown({}, {}).empty());
}

}  // namespace
}  // namespace light_field_depth
