#include "core/preprocess/sweep_views.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace light_field_depth
{
namespace
{
const cv::Mat IMAGE(60, 80, CV_8UC1, cv::Scalar(0));

LightField grid(int rows, int columns)
{
  std::vector<View> views;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      views.push_back(gridView(row, column, IMAGE));
    }
  }
  return makeLightField(views);
}

cv::Mat noisyImage(double sigma)
{
  cv::Mat values(120, 160, CV_32FC1);
  cv::RNG random(3);
  random.fill(values, cv::RNG::NORMAL, 128.0, sigma);
  cv::Mat image;
  values.convertTo(image, CV_8U);
  return image;
}

TEST(SweepViews, ArmsHaveTheNearestTheFarthestAndOneBetween)
{
  const LightField field = grid(3, 9);
  const std::vector<AxisArm> arms = axisArmsOf(field);
  ASSERT_EQ(arms.size(), 4U);
  ASSERT_EQ(arms[0].size(), 3U);
  EXPECT_EQ(arms[0][0]->steps, cv::Point2d(1, 0));
  EXPECT_EQ(arms[0][1]->steps, cv::Point2d(3, 0));
  EXPECT_EQ(arms[0][2]->steps, cv::Point2d(4, 0));
  ASSERT_EQ(arms[1].size(), 3U);
  EXPECT_EQ(arms[1][0]->steps, cv::Point2d(-1, 0));
  ASSERT_EQ(arms[2].size(), 1U);
  EXPECT_EQ(arms[2][0]->steps, cv::Point2d(0, 1));
  ASSERT_EQ(arms[3].size(), 1U);
  EXPECT_DOUBLE_EQ(nearestDistance(arms), 1.0);
  EXPECT_DOUBLE_EQ(farthestDistance(arms), 4.0);
}

TEST(SweepViews, ViewsBesideTheAxesCountWhereThereIsNothingOnThem)
{
  LightField field = grid(3, 3);
  field.views = {field.views[0], field.views[4], field.views[8]};
  field.reference_index = 1;
  const std::vector<AxisArm> arms = axisArmsOf(field);
  ASSERT_EQ(arms.size(), 2U);
  EXPECT_EQ(arms[0][0]->steps, cv::Point2d(1, 1));
  EXPECT_EQ(arms[1][0]->steps, cv::Point2d(-1, -1));
  EXPECT_NEAR(nearestDistance(arms), 1.41421356, 1e-8);
}

TEST(SweepViews, TheLargestDisparityEndsAtTheDisplacementOrAtTwoFifthsOfTheSide)
{
  const LightField field = grid(3, 3);
  const std::vector<AxisArm> arms = axisArmsOf(field);
  EXPECT_FLOAT_EQ(largestDisparity(arms, 10.0F), 10.0F);
  EXPECT_FLOAT_EQ(largestDisparity(arms, 48.0F), 24.0F);  // 0.4 of 60 pixels
  EXPECT_FLOAT_EQ(disparityOfFraction(arms, 0.5), 30.0F);
}

TEST(SweepViews, FarViewsTakeNoPartInAWideRange)
{
  EXPECT_DOUBLE_EQ(largestDistance({-4.0F, 60.0F}, 0.5), 16.0);  // 2048 labels
  EXPECT_EQ(largestDistance({1.0F, 1.0F}, 0.5), std::numeric_limits<double>::max());
}

TEST(SweepViews, HalvingsStopBeforeTheSideAndBeforeSixteenPixels)
{
  EXPECT_EQ(halvingsFor({512, 512}, 96), 2);
  EXPECT_EQ(halvingsFor({384, 100}, 96), 2);
  EXPECT_EQ(halvingsFor({383, 100}, 96), 1);
  EXPECT_EQ(halvingsFor({640, 40}, 96), 1);
  EXPECT_EQ(halvingsFor({80, 60}, 96), 0);
}

TEST(SweepViews, HalvingTakesTheMeanOfFourPixels)
{
  const cv::Mat image = (cv::Mat_<std::uint8_t>(2, 5) << 10, 20, 100, 100, 7, 30, 40, 100, 104, 7);
  const cv::Mat half = halve(image, 1);
  ASSERT_EQ(half.size(), cv::Size(2, 1)) << "the odd column is left out";
  EXPECT_EQ(half.at<std::uint8_t>(0, 0), 25);
  EXPECT_EQ(half.at<std::uint8_t>(0, 1), 101);
  EXPECT_EQ(halve(image, 0).data, image.data);
}

TEST(SweepViews, TheBlurGrowsWithTheNoise)
{
  EXPECT_EQ(blurFor(noisyImage(0.3)), 1);
  EXPECT_EQ(blurFor(noisyImage(1.5)), 3);
  EXPECT_EQ(blurFor(noisyImage(4.0)), 5);
  const cv::Mat image = noisyImage(4.0);
  EXPECT_EQ(blurred(image, 1).data, image.data);
  cv::Scalar mean;
  cv::Scalar before;
  cv::Scalar after;
  cv::meanStdDev(image, mean, before);
  cv::meanStdDev(blurred(image, 5), mean, after);
  EXPECT_NEAR(mean[0], 128.0, 0.3);
  // The kernel 1 4 6 4 1 along both axes leaves 70/256 of the deviation of white noise.
  EXPECT_NEAR(after[0] / before[0], 70.0 / 256.0, 0.03);
}

}  // namespace
}  // namespace light_field_depth
