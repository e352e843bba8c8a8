#include "light_field_depth/ros/image_conversion.h"

#include <cstring>
#include <utility>

#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>

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

TEST(ImageConversion, NamesViewAndFieldOfWhatCannotBeUsed)
{
  const sensor_msgs::Image good = message(encodings::MONO8, pattern(CV_8UC1));
  sensor_msgs::Image bayer = good;
  bayer.encoding = encodings::BAYER_RGGB8;
  expectSentence([&] { imageFromMessage(bayer, "View (1, 2)"); }, {"View (1, 2)", "bayer_rggb8", "debayer"});
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
  sensor_msgs::Image swapped = message(encodings::MONO16, pattern(CV_16UC1));
  swapped.is_bigendian = swapped.is_bigendian != 0 ? 0 : 1;
  expectSentence([&] { imageFromMessage(swapped, "View (1, 2)"); }, {"View (1, 2)", "is_bigendian"});
}

}  // namespace
}  // namespace light_field_depth
