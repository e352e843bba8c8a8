// Images as drivers publish them.

#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/image_encodings.h>
#include <stereo_msgs/DisparityImage.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "array_fixture.h"
#include "light_field_depth/LightFieldDepthStats.h"

namespace light_field_depth::testing
{
namespace
{
using ImageKindsTest = ArrayFixture;
using DisparityListener = Listener<stereo_msgs::DisparityImage>;

cv::Mat pixelsOf(const stereo_msgs::DisparityImage& disparity)
{
  return cv_bridge::toCvCopy(disparity.image)->image;
}

cv::Mat pixelsOf(const sensor_msgs::Image& image)
{
  return cv_bridge::toCvCopy(image)->image;
}

TEST_F(ImageKindsTest, CompressedTopicsGiveTheSameAsRawOnes)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), {64, 48});
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  cv::Mat expected;
  {
    const DisparityListener disparity(*node_space_, "disparity");
    ASSERT_TRUE(publishUntil(array, [&] { return disparity.count() > 0; }));
    expected = pixelsOf(*disparity.newest());
  }
  node_.reset();
  setParameter("image_transport", std::string("compressed"));
  startNode(scene.light_field);
  std::vector<ros::Publisher> publishers;
  std::vector<sensor_msgs::CompressedImage> images(3);
  for (std::size_t view = 0; view < 3; ++view)
  {
    publishers.push_back(array_space_->advertise<sensor_msgs::CompressedImage>(
        "view_0_" + std::to_string(view) + "/image_rect_color/compressed", 5));
    images[view].format = "bgr8; png compressed bgr8";
    cv::imencode(".png", pixelsOf(array.image(view)), images[view].data);
  }
  const DisparityListener disparity(*node_space_, "disparity");
  EXPECT_TRUE(waitFor(
      [&]
      {
        array.publishInfos(nextStamp(), [](std::size_t) { return true; });
        for (std::size_t view = 0; view < 3; ++view)
        {
          images[view].header.stamp = stamp_;
          images[view].header.frame_id = "array_optical_frame";
          publishers[view].publish(images[view]);
        }
        return waitFor([&] { return disparity.count() > 0; }, std::chrono::milliseconds(50));
      }));
  ASSERT_GT(disparity.count(), 0U);
  EXPECT_EQ(cv::norm(pixelsOf(*disparity.newest()), expected, cv::NORM_INF), 0.0);
}

TEST_F(ImageKindsTest, BayerAndBigEndianImagesAreTaken)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), {64, 48});
  ArrayPublisher array(*array_space_, scene.light_field);
  for (std::size_t view = 0; view < 3; ++view)
  {
    cv::Mat deep;
    cv::Mat grey;
    cv::cvtColor(pixelsOf(array.image(view)), grey, cv::COLOR_BGR2GRAY);
    grey.convertTo(deep, CV_16U, 256.0);
    sensor_msgs::Image raw = *cv_bridge::CvImage({}, "mono16", deep).toImageMsg();
    raw.encoding = sensor_msgs::image_encodings::BAYER_RGGB16;
    raw.is_bigendian = raw.is_bigendian != 0 ? 0 : 1;
    for (std::size_t i = 0; i + 1 < raw.data.size(); i += 2)
    {
      std::swap(raw.data[i], raw.data[i + 1]);
    }
    array.image(view) = raw;
  }
  startNode(scene.light_field);
  const Listener<sensor_msgs::Image> reference(*node_space_, "left/image_rect_color");
  const DisparityListener disparity(*node_space_, "disparity");
  ASSERT_TRUE(publishUntil(array, [&] { return disparity.count() > 0 && reference.count() > 0; }));
  EXPECT_EQ(reference.newest()->encoding, "bgr16") << "the image as it is used";
}

TEST_F(ImageKindsTest, RawImagesAreRectifiedAndReduced)
{
  const cv::Size size(128, 96);
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), size);
  ArrayPublisher array(*array_space_, scene.light_field);
  for (std::size_t view = 0; view < 3; ++view)
  {
    array.info(view).D[0] = 1e-9;  // next to no distortion, but one that has to be taken out
  }
  setParameter("rectify", true);
  setParameter("decimation", 2);
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  const Listener<sensor_msgs::Image> reference(*node_space_, "left/image_rect_color");
  const Listener<sensor_msgs::CameraInfo> info(*node_space_, "camera_info");
  ASSERT_TRUE(publishUntil(
      array, [&] { return disparity.count() > 0 && reference.count() > 0 && info.count() > 0; }));
  EXPECT_EQ(disparity.newest()->image.width, 64U);
  EXPECT_NEAR(disparity.newest()->f, 0.5 * scene.light_field.calibration->focal_length_px, 1e-4);
  EXPECT_EQ(reference.newest()->width, 64U);
  EXPECT_EQ(info.newest()->width, 64U);
  EXPECT_EQ(info.newest()->D[0], 0.0);
}

/// The share of a part of a disparity that is invalid.
double invalidShare(const stereo_msgs::DisparityImage& disparity, int first_column, int end_column)
{
  const cv::Mat part = pixelsOf(disparity).colRange(first_column, end_column);
  return static_cast<double>(cv::countNonZero(part < disparity.min_disparity)) /
         static_cast<double>(part.total());
}

TEST_F(ImageKindsTest, WhatIsMaskedIsInvalidWhereverTheMaskComesFrom)
{
  const cv::Size size(128, 96);
  constexpr int MASKED = 12;
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), size);
  for (const std::string source : {"black", "topic", "alpha"})
  {
    SCOPED_TRACE(source);
    ArrayPublisher array(*array_space_, scene.light_field);
    std::vector<ros::Publisher> masks;
    TopicPatterns patterns;
    for (std::size_t view = 0; view < 3; ++view)
    {
      cv::Mat image = pixelsOf(array.image(view));
      cv::Mat mask(size, CV_8UC1, cv::Scalar(255));
      mask.colRange(0, MASKED).setTo(0);
      image.setTo(cv::Scalar(), mask == 0);
      std::string encoding = "bgr8";
      if (source == "alpha")
      {
        cv::merge(std::vector<cv::Mat>{image, mask}, image);
        encoding = "bgra8";
      }
      array.image(view) = *cv_bridge::CvImage(array.image(view).header, encoding, image).toImageMsg();
      masks.push_back(
          array_space_->advertise<sensor_msgs::Image>("view_0_" + std::to_string(view) + "/mask", 1, true));
      masks.back().publish(cv_bridge::CvImage({}, "mono8", mask).toImageMsg());
    }
    setParameter("mask_black", source == "black");
    std::map<std::string, std::string> fields;
    if (source == "topic")
    {
      fields["mask"] = "view_{row}_{column}/mask";
    }
    startNode(scene.light_field, patterns, nullptr, fields);
    const DisparityListener disparity(*node_space_, "disparity");
    const auto isMasked = [&]
    { return disparity.count() > 0 && invalidShare(*disparity.newest(), 0, MASKED) == 1.0; };
    ASSERT_TRUE(publishUntil(array, isMasked));
    const stereo_msgs::DisparityImage& result = *disparity.newest();
    EXPECT_LT(invalidShare(result, MASKED + 1, size.width), 0.1);
    EXPECT_NEAR(result.valid_window.x_offset, MASKED, 1);
    EXPECT_EQ(result.valid_window.x_offset + result.valid_window.width, 128U);
    node_.reset();
  }
}

TEST_F(ImageKindsTest, WhatRectificationCannotFillIsInvalid)
{
  const cv::Size size(128, 96);
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), size);
  ArrayPublisher array(*array_space_, scene.light_field);
  for (std::size_t view = 0; view < 3; ++view)
  {
    array.info(view).P[2] +=
        10.0;  // the plane's camera looks 10 px further to the left than the image begins
  }
  setParameter("rectify", true);
  startNode(scene.light_field);
  const DisparityListener disparity(*node_space_, "disparity");
  ASSERT_TRUE(publishUntil(array, [&] { return disparity.count() > 0; }));
  EXPECT_EQ(invalidShare(*disparity.newest(), 0, 10), 1.0);
  EXPECT_EQ(disparity.newest()->valid_window.x_offset, 10U);
  EXPECT_EQ(disparity.newest()->valid_window.width, 118U);
}

/// Grey levels of 8 bits as levels of another range.
cv::Mat asSixteenBits(const cv::Mat& bgr, double darkest, double brightest)
{
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  cv::Mat deep;
  grey.convertTo(deep, CV_16U, (brightest - darkest) / 255.0, darkest);
  return deep;
}

TEST_F(ImageKindsTest, AThermalRangeAndAHotPixelCostNothing)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), {96, 72});
  const auto offset_px = static_cast<float>(scene.light_field.calibration->disparity_offset_px);
  const std::vector<std::string> kinds = {"8 bits", "51241..52181", "10 bits, one pixel at 65535"};
  std::vector<double> bad;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
  {
    SCOPED_TRACE(kinds[kind]);
    ArrayPublisher array(*array_space_, scene.light_field);
    for (std::size_t view = 0; view < 3; ++view)
    {
      sensor_msgs::Image& image = array.image(view);
      cv::Mat deep = kind == 1 ? asSixteenBits(pixelsOf(image), 51241.0, 52181.0)
                               : asSixteenBits(pixelsOf(image), 0.0, kind == 0 ? 255.0 : 1023.0);
      if (kind == 0)
      {
        deep.convertTo(deep, CV_8U);
      }
      if (kind == 2 && view == 1)
      {
        deep.at<std::uint16_t>(20, 30) = 65535;
      }
      image = *cv_bridge::CvImage(image.header, kind == 0 ? "mono8" : "mono16", deep).toImageMsg();
    }
    startNode(scene.light_field);
    const DisparityListener disparity(*node_space_, "disparity");
    ASSERT_TRUE(publishUntil(array, [&] { return disparity.count() > 0; }));
    bad.push_back(badPercentage(pixelsOf(*disparity.newest()) - offset_px, scene.truth, 0.5));
    node_.reset();
  }
  EXPECT_LT(bad[1], bad[0] + 1.0);
  EXPECT_LT(bad[2], bad[0] + 1.0);
}

}  // namespace
}  // namespace light_field_depth::testing
