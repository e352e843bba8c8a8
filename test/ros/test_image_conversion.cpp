#include "light_field_depth/ros/image_conversion.h"

#include <cstdint>
#include <cstring>
#include <utility>

#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>
#include <opencv2/imgcodecs.hpp>

#include "expect_sentence.h"

namespace light_field_depth
{
namespace
{
namespace encodings = sensor_msgs::image_encodings;
using testing::expectSentence;

cv::Mat pattern(int type)
{
  cv::Mat image(20, 30, type);
  cv::RNG(3).fill(image, cv::RNG::UNIFORM, 0, CV_MAT_DEPTH(type) == CV_8U ? 256 : 65536);
  return image;
}

sensor_msgs::Image message(const std::string& encoding, const cv::Mat& image)
{
  return *cv_bridge::CvImage({}, encoding, image).toImageMsg();
}

bool sharesMemory(const cv::Mat& image, const sensor_msgs::Image& message)
{
  return image.data >= message.data.data() && image.data < message.data.data() + message.data.size();
}

double difference(const cv::Mat& a, const cv::Mat& b)
{
  return a.type() == b.type() ? cv::norm(a, b, cv::NORM_INF) : -1.0;
}

TEST(ImageConversion, SharesTheMemoryWhereTheEncodingAllows)
{
  const std::vector<std::pair<std::string, int>> cases = {
      {encodings::MONO8, CV_8UC1},       {encodings::TYPE_8UC1, CV_8UC1}, {encodings::BGR8, CV_8UC3},
      {encodings::TYPE_8UC3, CV_8UC3},   {encodings::MONO16, CV_16UC1},   {encodings::TYPE_16UC1, CV_16UC1},
      {encodings::TYPE_16UC3, CV_16UC3}, {encodings::BGR16, CV_16UC3}};
  for (const auto& [encoding, type] : cases)
  {
    const cv::Mat image = pattern(type);
    const sensor_msgs::Image sent = message(encoding, image);
    const cv::Mat received = imageFromMessage(sent, "View (0, 0)");
    EXPECT_TRUE(sharesMemory(received, sent)) << encoding;
    EXPECT_EQ(difference(received, image), 0.0) << encoding;
  }
}

TEST(ImageConversion, TurnsOtherColourOrdersIntoBgr)
{
  const cv::Mat bgr = pattern(CV_8UC3);
  for (const std::string& encoding :
       {encodings::RGB8, encodings::RGBA8, encodings::BGRA8, encodings::RGB16, encodings::RGBA16})
  {
    const bool wide = encodings::bitDepth(encoding) == 16;
    cv::Mat expected = bgr;
    if (wide)
    {
      bgr.convertTo(expected, CV_16U, 257.0);
    }
    const auto source = cv_bridge::CvImage({}, wide ? encodings::BGR16 : encodings::BGR8, expected);
    const sensor_msgs::Image sent =
        *cv_bridge::cvtColor(boost::make_shared<cv_bridge::CvImage>(source), encoding)->toImageMsg();
    EXPECT_EQ(difference(imageFromMessage(sent, "View (0, 0)"), expected), 0.0) << encoding;
  }
}

TEST(ImageConversion, UnderstandsPaddedRows)
{
  const cv::Mat image = pattern(CV_8UC1);
  sensor_msgs::Image padded = message(encodings::MONO8, image);
  padded.step = 48;
  padded.data.assign(std::size_t{48} * 20, 0);
  for (int y = 0; y < image.rows; ++y)
  {
    std::memcpy(&padded.data[static_cast<std::size_t>(y) * 48], image.ptr(y), 30);
  }
  EXPECT_EQ(difference(imageFromMessage(padded, "View (0, 0)"), image), 0.0);
}

TEST(ImageConversion, UnderstandsRowsThatBeginBetweenTwoValues)
{
  const cv::Mat image = pattern(CV_16UC1);
  sensor_msgs::Image odd = message(encodings::MONO16, image);
  odd.step = 2 * 30 + 3;
  odd.data.assign(std::size_t{odd.step} * 20, 0);
  for (int y = 0; y < image.rows; ++y)
  {
    std::memcpy(&odd.data[static_cast<std::size_t>(y) * odd.step], image.ptr(y), 60);
  }
  EXPECT_EQ(difference(imageFromMessage(odd, "View (0, 0)"), image), 0.0);
}

TEST(ImageConversion, SwapsBytesOfTheOtherOrder)
{
  for (const int type : {CV_16UC1, CV_16UC3})
  {
    const cv::Mat image = pattern(type);
    sensor_msgs::Image swapped = message(type == CV_16UC1 ? encodings::MONO16 : encodings::BGR16, image);
    swapped.is_bigendian = swapped.is_bigendian != 0 ? 0 : 1;
    for (std::size_t i = 0; i + 1 < swapped.data.size(); i += 2)
    {
      std::swap(swapped.data[i], swapped.data[i + 1]);
    }
    EXPECT_EQ(difference(imageFromMessage(swapped, "View (0, 0)"), image), 0.0);
  }
}

/// A red, a green and a blue stripe, wide enough that demosaicking does not mix them in their middle.
cv::Mat stripes(int depth)
{
  cv::Mat image = cv::Mat::zeros(24, 36, CV_MAKETYPE(depth, 3));
  const double full = depth == CV_8U ? 200 : 50000;
  image.colRange(0, 12).setTo(cv::Scalar(0, 0, full));
  image.colRange(12, 24).setTo(cv::Scalar(0, full, 0));
  image.colRange(24, 36).setTo(cv::Scalar(full, 0, 0));
  return image;
}

/// What a sensor with a Bayer pattern sees of an image. @param pattern the colours of the first two rows
template <class Value>
cv::Mat mosaic(const cv::Mat& image, const std::string& pattern)
{
  cv::Mat raw(image.size(), CV_MAKETYPE(image.depth(), 1));
  for (int y = 0; y < raw.rows; ++y)
  {
    for (int x = 0; x < raw.cols; ++x)
    {
      const char colour = pattern[static_cast<std::size_t>(2 * (y % 2) + x % 2)];
      const int channel = colour == 'b' ? 0 : colour == 'g' ? 1 : 2;
      raw.at<Value>(y, x) = image.ptr<Value>(y)[3 * x + channel];
    }
  }
  return raw;
}

void expectStripes(const cv::Mat& converted, const cv::Mat& image)
{
  ASSERT_EQ(converted.type(), image.type());
  for (const int first : {2, 14, 26})
  {
    const cv::Rect middle(first, 2, 8, 20);
    EXPECT_EQ(cv::norm(converted(middle), image(middle), cv::NORM_INF), 0.0) << first;
  }
}

TEST(ImageConversion, DemosaicksEveryBayerPattern)
{
  for (const char* const pattern : {"rggb", "bggr", "gbrg", "grbg"})
  {
    const std::string name = std::string("bayer_") + pattern;
    const cv::Mat image = stripes(CV_8U);
    sensor_msgs::Image raw = message(encodings::MONO8, mosaic<std::uint8_t>(image, pattern));
    raw.encoding = name + "8";
    expectStripes(imageFromMessage(raw, name), image);
    const cv::Mat deep = stripes(CV_16U);
    raw = message(encodings::MONO16, mosaic<std::uint16_t>(deep, pattern));
    raw.encoding = name + "16";
    expectStripes(imageFromMessage(raw, name), deep);
  }
}

TEST(ImageConversion, ReadsYuv422)
{
  cv::Mat grey(20, 30, CV_8UC2, cv::Scalar(128, 180));  // U or V, then Y
  sensor_msgs::Image uyvy = message(encodings::TYPE_8UC2, grey);
  uyvy.encoding = encodings::YUV422;
  const cv::Mat converted = imageFromMessage(uyvy, "View (0, 0)");
  ASSERT_EQ(converted.type(), CV_8UC3);
  EXPECT_NEAR(converted.at<cv::Vec3b>(3, 3)[1], (180 - 16) * 255 / 219, 1);
  grey.setTo(cv::Scalar(180, 128));
  sensor_msgs::Image yuyv = message(encodings::TYPE_8UC2, grey);
  yuyv.encoding = "yuv422_yuy2";
  EXPECT_EQ(difference(imageFromMessage(yuyv, "View (0, 0)"), converted), 0.0);
}

TEST(ImageConversion, RefusesWhatCannotBeDecoded)
{
  sensor_msgs::CompressedImage message;
  message.format = "jpeg";
  expectSentence([&] { imageFromMessage(message, "View (1, 2)"); }, {"View (1, 2)", "0 bytes", "'jpeg'"});
  message.data.assign(100, 7);
  expectSentence([&] { imageFromMessage(message, "View (1, 2)"); },
                 {"View (1, 2)", "100 bytes", "JPEG or PNG"});
}

TEST(ImageConversion, NamesViewAndFieldOfWhatCannotBeUsed)
{
  const sensor_msgs::Image good = message(encodings::MONO8, pattern(CV_8UC1));
  sensor_msgs::Image floats = good;
  floats.encoding = encodings::TYPE_32FC1;
  expectSentence([&] { imageFromMessage(floats, "View (1, 2)"); }, {"View (1, 2)", "32FC1", "yuv422"});
  sensor_msgs::Image truncated = good;
  truncated.data.resize(100);
  expectSentence([&] { imageFromMessage(truncated, "View (1, 2)"); },
                 {"View (1, 2)", "100 bytes", "truncated"});
  sensor_msgs::Image narrow = good;
  narrow.step = 10;
  expectSentence([&] { imageFromMessage(narrow, "View (1, 2)"); }, {"View (1, 2)", "step is 10", "30"});
  sensor_msgs::Image empty = good;
  empty.width = 0;
  expectSentence([&] { imageFromMessage(empty, "View (1, 2)"); }, {"View (1, 2)", "0 x 20"});
  sensor_msgs::Image huge = good;
  huge.height = 4000000000U;
  expectSentence([&] { imageFromMessage(huge, "View (1, 2)"); }, {"View (1, 2)", "4000000000"});
}

TEST(ImageConversion, AlphaIsTheMask)
{
  cv::Mat image = pattern(CV_8UC4);
  image.forEach<cv::Vec4b>([](cv::Vec4b& pixel, const int* at) { pixel[3] = at[1] < 4 ? 0 : 255; });
  for (const bool compressed : {false, true})
  {
    cv::Mat mask;
    cv::Mat converted;
    if (compressed)
    {
      sensor_msgs::CompressedImage png;
      cv::imencode(".png", image, png.data);
      converted = imageFromMessage(png, "View", &mask);
    }
    else
    {
      converted = imageFromMessage(message(encodings::BGRA8, image), "View", &mask);
    }
    EXPECT_EQ(converted.type(), CV_8UC3);
    ASSERT_EQ(mask.size(), image.size());
    EXPECT_EQ(cv::countNonZero(mask), (image.cols - 4) * image.rows);
    EXPECT_EQ(cv::countNonZero(mask.colRange(0, 4)), 0);
  }
  cv::Mat mask(3, 3, CV_8UC1);
  imageFromMessage(message(encodings::BGR8, pattern(CV_8UC3)), "View", &mask);
  EXPECT_TRUE(mask.empty());
}

TEST(ImageConversion, MasksAreImagesOfAnyEncoding)
{
  cv::Mat image = cv::Mat::zeros(20, 30, CV_8UC1);
  image.row(2).setTo(1);
  const cv::Mat mask = maskFromMessage(message(encodings::MONO8, image), "View");
  EXPECT_EQ(cv::countNonZero(mask), 30);
  expectSentence([] { maskFromMessage(sensor_msgs::Image(), "View, mask"); }, {"View, mask", "encoding"});
}

}  // namespace
}  // namespace light_field_depth
