#include "light_field_depth/io/disparity_image.h"

#include <limits>

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

TEST(DisparityImage, ShowsNearRedFarBlueAndUnknownGrey)
{
  cv::Mat disparity(64, 64, CV_32FC1, cv::Scalar(-1.0));
  disparity.colRange(32, 64).setTo(2.0);
  disparity.row(0).setTo(NaN);
  const DisparityRange range = shownRange(disparity);
  EXPECT_FLOAT_EQ(range.min, -1.0F);
  EXPECT_FLOAT_EQ(range.max, 2.0F);
  const cv::Mat image = disparityWithScale(disparity, range);
  EXPECT_EQ(image.type(), CV_8UC3);
  EXPECT_EQ(image.rows, 64);
  EXPECT_GT(image.cols, 64);
  const auto far = image.at<cv::Vec3b>(30, 5);
  const auto near = image.at<cv::Vec3b>(30, 60);
  EXPECT_GT(far[0], far[2]);
  EXPECT_GT(near[2], near[0] + 50);
  EXPECT_EQ(image.at<cv::Vec3b>(0, 5), cv::Vec3b(128, 128, 128));
}

TEST(DisparityImage, ManagesFlatUnknownAndTinyMaps)
{
  for (const cv::Mat& map :
       {cv::Mat(16, 16, CV_32FC1, cv::Scalar(0.5)), cv::Mat(16, 16, CV_32FC1, cv::Scalar(NaN)),
        cv::Mat(1, 1, CV_32FC1, cv::Scalar(3.0)),
        cv::Mat(20, 20, CV_32FC1, cv::Scalar(std::numeric_limits<float>::infinity()))})
  {
    const DisparityRange range = shownRange(map);
    EXPECT_LT(range.min, range.max);
    EXPECT_EQ(disparityWithScale(map, range).rows, map.rows);
  }
}

TEST(DisparityImage, ThePreviewShowsThreePictures)
{
  const cv::Mat disparity(30, 40, CV_32FC1, cv::Scalar(1.0));
  const cv::Mat confidence(30, 40, CV_32FC1, cv::Scalar(1.0));
  const cv::Mat grey(30, 40, CV_8UC1, cv::Scalar(77));
  const cv::Mat preview = previewImage(grey, disparity, confidence);
  EXPECT_EQ(preview.type(), CV_8UC3);
  EXPECT_EQ(preview.at<cv::Vec3b>(preview.rows - 1, 3), cv::Vec3b(77, 77, 77));
  EXPECT_GT(preview.cols, 3 * 40);
  EXPECT_EQ(previewImage(cv::Mat(30, 40, CV_16UC3, cv::Scalar::all(60000)), disparity, confidence).size(),
            preview.size());
}

}  // namespace
}  // namespace light_field_depth
