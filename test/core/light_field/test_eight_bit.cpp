#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
namespace
{
TEST(ToEightBit, SharesImagesOfEightBits)
{
  const cv::Mat image(16, 16, CV_8UC3, cv::Scalar(1, 2, 3));
  EXPECT_EQ(toEightBit(makeLightField({gridView(0, 0, image), gridView(0, 1, image)})).views[1].image.data,
            image.data);
}

TEST(ToEightBit, ScalesAllViewsByOneFactor)
{
  std::vector<View> views = {gridView(0, 0, cv::Mat(16, 16, CV_16UC1, cv::Scalar(1000))),
                             gridView(0, 1, cv::Mat(16, 16, CV_16UC1, cv::Scalar(500)))};
  const LightField eight_bit = toEightBit(makeLightField(views));
  EXPECT_EQ(eight_bit.views[0].image.type(), CV_8UC1);
  EXPECT_NEAR(eight_bit.views[0].image.at<std::uint8_t>(3, 3), 1000 * 255.0 / 1023, 0.51);
  EXPECT_NEAR(eight_bit.views[1].image.at<std::uint8_t>(3, 3), 500 * 255.0 / 1023, 0.51);
}

TEST(ToEightBit, IsNotDecidedByTheBrightestPixel)
{
  cv::Mat image(64, 64, CV_16UC1, cv::Scalar(100));
  image.colRange(0, 32).setTo(cv::Scalar(1000));
  image.at<std::uint16_t>(8, 8) = 65535;
  const LightField eight_bit = toEightBit(makeLightField({gridView(0, 0, image), gridView(0, 1, image)}));
  EXPECT_NEAR(eight_bit.views[0].image.at<std::uint8_t>(3, 3), 1000 * 255.0 / 1023, 0.51);
  EXPECT_EQ(eight_bit.views[0].image.at<std::uint8_t>(8, 8), 255);
}

TEST(ToEightBit, SpreadsANarrowRange)
{
  cv::Mat image(64, 64, CV_16UC1);
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      image.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(51241 + 940 * x / 63);
    }
  }
  const LightField eight_bit = toEightBit(makeLightField({gridView(0, 0, image), gridView(0, 1, image)}));
  const cv::Mat& shown = eight_bit.views[1].image;
  EXPECT_GT(shown.at<std::uint8_t>(5, 63) - shown.at<std::uint8_t>(5, 0), 190) << "as a thermal camera's";
  EXPECT_GT(shown.at<std::uint8_t>(5, 0), 0);
  EXPECT_LT(shown.at<std::uint8_t>(5, 63), 255);
}

TEST(ToEightBit, AWindowBeginsAndEndsAtRoundLevels)
{
  // A video whose brightness wanders a little keeps its window, so that its frames look alike.
  const auto shown = [](int darkest)
  {
    cv::Mat image(64, 64, CV_16UC1);
    for (int i = 0; i < 64 * 64; ++i)
    {
      image.ptr<std::uint16_t>()[i] = static_cast<std::uint16_t>(darkest + 900 * (i % 64) / 63);
    }
    return toEightBit(makeLightField({gridView(0, 0, image), gridView(0, 1, image)})).views[0].image;
  };
  const int step = shown(30010).at<std::uint8_t>(0, 63) - shown(30000).at<std::uint8_t>(0, 63);
  EXPECT_GE(step, 2) << "ten levels of the same window";
  EXPECT_LE(step, 3);
}

}  // namespace
}  // namespace light_field_depth
