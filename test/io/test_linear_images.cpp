#include "io/linear_images.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace light_field_depth
{
namespace
{
TEST(LinearImages, WhiteIsOneOrWhatAllButAThousandthStayBelow)
{
  cv::Mat image(100, 100, CV_32FC1, cv::Scalar(0.5));
  EXPECT_FLOAT_EQ(whiteOf(image), 1.0F);
  image.setTo(3.0);
  image.row(0).colRange(0, 9).setTo(500.0);  // a glint
  image.at<float>(5, 5) = std::numeric_limits<float>::infinity();
  EXPECT_FLOAT_EQ(whiteOf(image), 3.0F);
  EXPECT_FLOAT_EQ(whiteOf(cv::Mat(2, 2, CV_32FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()))),
                  1.0F);
}

TEST(LinearImages, LevelsFollowTheCurveOfSrgb)
{
  const cv::Mat light = (cv::Mat_<float>(1, 6) << 0.0F, 0.001F, 0.2140411F, 1.0F, 9.0F,
                         std::numeric_limits<float>::quiet_NaN());
  const cv::Mat levels = encodedLinear(light, 1.0F);
  ASSERT_EQ(levels.type(), CV_16UC1);
  EXPECT_EQ(levels.at<std::uint16_t>(0, 0), 0);
  EXPECT_NEAR(levels.at<std::uint16_t>(0, 1), 65535 * 0.01292, 1.0) << "the straight part";
  EXPECT_NEAR(levels.at<std::uint16_t>(0, 2), 65535 * 0.5, 2.0) << "half of the way to the eye";
  EXPECT_EQ(levels.at<std::uint16_t>(0, 3), 65535);
  EXPECT_EQ(levels.at<std::uint16_t>(0, 4), 65535);
  EXPECT_EQ(levels.at<std::uint16_t>(0, 5), 0) << "what is not a number is black";
}

TEST(LinearImages, WhiteScalesColour)
{
  const cv::Mat light(1, 1, CV_32FC3, cv::Scalar(0.4, 0.2, 0.0));
  const cv::Mat levels = encodedLinear(light, 0.4F);
  ASSERT_EQ(levels.type(), CV_16UC3);
  EXPECT_EQ(levels.ptr<std::uint16_t>()[0], 65535);
  EXPECT_NEAR(levels.ptr<std::uint16_t>()[1], 65535 * 0.7353569, 2.0);
  EXPECT_EQ(levels.ptr<std::uint16_t>()[2], 0);
}

}  // namespace
}  // namespace light_field_depth
