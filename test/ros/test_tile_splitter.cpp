#include "light_field_depth/ros/tile_splitter.h"

#include <string>
#include <utility>

#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "expect_sentence.h"

namespace light_field_depth
{
namespace
{
using testing::expectSentence;

sensor_msgs::Image message(const std::string& encoding, int type, const cv::Size& size)
{
  cv::Mat image(size, type);
  cv::RNG(5).fill(image, cv::RNG::UNIFORM, 0, 255);
  std_msgs::Header header;
  header.stamp = ros::Time(3, 4);
  return *cv_bridge::CvImage(header, encoding, image).toImageMsg();
}

TEST(TileSplitter, TilesAreThePartsOfTheImage)
{
  for (const auto& [encoding, type] : {std::make_pair("bgr8", CV_8UC3), std::make_pair("mono16", CV_16UC1)})
  {
    const sensor_msgs::Image image = message(encoding, type, {60, 40});
    const cv::Mat whole = cv_bridge::toCvCopy(image)->image;
    for (int row = 0; row < 2; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        const sensor_msgs::ImagePtr tile = tileOf(image, {2, 3}, row, column);
        EXPECT_EQ(tile->header.stamp, image.header.stamp);
        const cv::Mat expected = whole({column * 20, row * 20, 20, 20});
        EXPECT_EQ(cv::norm(cv_bridge::toCvCopy(*tile)->image, expected, cv::NORM_INF), 0.0);
      }
    }
  }
}

TEST(TileSplitter, RefusesWhatCannotBeDivided)
{
  expectSentence([] { tileOf(message("bgr8", CV_8UC3, {60, 40}), {3, 3}, 0, 0); }, {"60 x 40", "3 rows"});
  expectSentence([] { tileOf(message("bayer_rggb8", CV_8UC1, {30, 20}), {2, 2}, 0, 0); }, {"bayer"});
  sensor_msgs::Image image = message("bgr8", CV_8UC3, {60, 40});
  image.encoding = "what";
  expectSentence([&] { tileOf(image, {2, 2}, 0, 0); }, {"what"});
  image.encoding = "bgr8";
  image.data.resize(100);
  expectSentence([&] { tileOf(image, {2, 2}, 0, 0); }, {"less data"});
}

}  // namespace
}  // namespace light_field_depth
