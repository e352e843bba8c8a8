#include <cstdlib>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "core/paper2017/dense_descriptor.h"

namespace light_field_depth
{
namespace
{
cv::Mat randomImage(int type, const cv::Size& size = {40, 30}, int seed = 1)
{
  cv::RNG random(static_cast<std::uint64_t>(seed));
  cv::Mat image(size, type);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(image, image, {0, 0}, 1.2);
  return image;
}

int distance(const DescriptorImage& a, const cv::Point& p, const DescriptorImage& b, const cv::Point& q)
{
  return descriptorDistance(a.at(p.x, p.y), a.stride(), b.at(q.x, q.y), b.stride());
}

/// The definition: 4 x 4 cells of 8 bytes, two pixels apart.
int plainDistance(const DescriptorImage& a, const cv::Point& p, const DescriptorImage& b, const cv::Point& q)
{
  int sum = 0;
  for (int i = 0; i < 16 * 8; ++i)
  {
    const int row = i / 8 / 4 * 2;
    const std::size_t byte = static_cast<std::size_t>(i / 8 % 4 * 2 * 8 + i % 8);
    sum += std::abs(a.at(p.x, p.y + row)[byte] - b.at(q.x, q.y + row)[byte]);
  }
  return sum;
}

TEST(DenseDescriptor, DistanceIsTheSumOverSixteenCells)
{
  const DescriptorImage a(randomImage(CV_8UC3, {40, 40}, 1));
  const DescriptorImage b(randomImage(CV_8UC3, {40, 40}, 2));
  for (int i = 0; i < 30; ++i)
  {
    const cv::Point p(i, 30 - i);
    const cv::Point q(29 - i, i / 2);
    EXPECT_EQ(distance(a, p, b, q), plainDistance(a, p, b, q));
  }
}

TEST(DenseDescriptor, FindsAShiftedPatchInGreyAndColour)
{
  for (const int type : {CV_8UC1, CV_8UC3})
  {
    const cv::Mat image = randomImage(type, {60, 40});
    const DescriptorImage from(image(cv::Rect(0, 0, 50, 40)));
    const DescriptorImage to(image(cv::Rect(7, 0, 50, 40)));
    const cv::Point p(25, 20);
    for (int shift = -12; shift <= 12; ++shift)
    {
      const int cost = distance(from, p, to, p + cv::Point(shift, 0));
      EXPECT_EQ(cost == 0, shift == -7) << shift;
    }
  }
}

TEST(DenseDescriptor, DoesNotDependOnBrightnessOrGain)
{
  const cv::Mat image = randomImage(CV_8UC1, {60, 40}) / 2;
  const DescriptorImage plain(image);
  const DescriptorImage brighter(image + 60);
  EXPECT_EQ(distance(plain, {20, 20}, brighter, {20, 20}), 0);
  const DescriptorImage stronger(image * 2);
  EXPECT_LT(distance(plain, {20, 20}, stronger, {20, 20}), distance(plain, {20, 20}, plain, {24, 20}) / 4);
}

TEST(DenseDescriptor, CentreShareIsSmallBesideAnEdge)
{
  cv::Mat image(40, 40, CV_8UC1, cv::Scalar(50));
  image.colRange(20, 40).setTo(200);
  const DescriptorImage descriptors(image);
  const cv::Mat& share = descriptors.centreShare();
  EXPECT_FLOAT_EQ(share.at<float>(20, 20), 1.0F);
  EXPECT_LT(share.at<float>(20, 15), 0.01F);
  EXPECT_FLOAT_EQ(share.at<float>(20, 5), 1.0F);
}

TEST(DenseDescriptor, PyramidHalvesAndStopsBeforeImagesBecomeTooSmall)
{
  EXPECT_EQ(usablePyramidLevels({512, 512}, 5, 0.5), 5);
  EXPECT_EQ(usablePyramidLevels({128, 96}, 5, 0.5), 3);
  EXPECT_EQ(usablePyramidLevels({16, 16}, 5, 0.5), 1);
  const auto pyramid = descriptorPyramid(randomImage(CV_8UC1, {64, 48}), 3, 0.5);
  ASSERT_EQ(pyramid.size(), 3U);
  EXPECT_EQ(pyramid[2].size(), cv::Size(16, 12));
}

}  // namespace
}  // namespace light_field_depth
