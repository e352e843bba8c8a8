#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/refine/noise_discount.h"

namespace light_field_depth::multiview
{
namespace
{
Linearization curvatureOf(const cv::Size& size, float curvature, float noise)
{
  Linearization linearization;
  linearization.weight = cv::Mat(size, CV_32FC1, cv::Scalar(curvature));
  linearization.noise = cv::Mat(size, CV_32FC1, cv::Scalar(noise));
  return linearization;
}

TEST(NoiseDiscount, LeavesCleanViewsAsTheyAre)
{
  Linearization linearization = curvatureOf({70, 41}, 0.1F, 0.0F);
  linearization.weight.colRange(30, 70).setTo(900.0F);
  ThreadPool pool(2);
  NoiseDiscount().apply({}, pool, linearization);
  EXPECT_EQ(linearization.weight.at<float>(20, 10), 0.1F);
  EXPECT_EQ(linearization.weight.at<float>(20, 50), NoiseDiscountSettings().max_weight);
}

/// Single windows of a blank wall are above the noise by chance; all of it is not.
TEST(NoiseDiscount, NothingCountsWhereAllIsNoise)
{
  Linearization linearization = curvatureOf({120, 80}, 10.0F, 10.0F);
  for (int y = 0; y < 80; y += 9)
  {
    linearization.weight.row(y).setTo(18.0F);
  }
  linearization.weight.colRange(100, 120).setTo(100.0F);
  ThreadPool pool(1);
  NoiseDiscount().apply({}, pool, linearization);
  EXPECT_EQ(cv::countNonZero(linearization.weight.colRange(0, 84)), 0);
  EXPECT_EQ(linearization.weight.at<float>(40, 115), 100.0F - NoiseDiscountSettings().margin * 10.0F);
}

}  // namespace
}  // namespace light_field_depth::multiview
