#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/maps/upsampling.h"

namespace light_field_depth::multiview
{
namespace
{
/// A slanted plane, and from a column on another one that is nearer; the image shows the border.
struct Step
{
  static constexpr int BORDER = 33;  // odd: in the middle of a reduced pixel
  cv::Mat image = cv::Mat(48, 70, CV_8UC3, cv::Scalar(40, 60, 80));
  cv::Mat truth = cv::Mat(48, 70, CV_32FC1);
  cv::Mat half = cv::Mat(24, 35, CV_32FC1);

  static float at(double x, double y) { return static_cast<float>((x >= BORDER ? 1.5 : 0.0) + 0.01 * y); }

  Step()
  {
    image.colRange(BORDER, image.cols).setTo(cv::Scalar(180, 150, 120));
    for (int y = 0; y < truth.rows; ++y)
    {
      for (int x = 0; x < truth.cols; ++x)
      {
        truth.at<float>(y, x) = at(x, y);
        half.at<float>(y / 2, x / 2) = at(x - x % 2 + 0.5, y - y % 2 + 0.5);
      }
    }
  }
};

TEST(Upsampling, FollowsTheEdgeOfTheImageAndThePlanesBesideIt)
{
  const Step step;
  const cv::Mat half_confidence(step.half.size(), CV_32FC1, 0.5F);
  ThreadPool pool(2);
  cv::Mat disparity;
  cv::Mat confidence;
  upsample(step.half, half_confidence, 0.2F, step.image, pool, disparity, confidence);
  ASSERT_EQ(disparity.size(), step.truth.size());
  const cv::Rect inner(2, 4, 66, 40);
  EXPECT_LT(cv::norm(disparity(inner), step.truth(inner), cv::NORM_INF), 0.02);
  EXPECT_EQ(cv::norm(confidence, cv::Mat(confidence.size(), CV_32FC1, 0.5F), cv::NORM_INF), 0.0);
}

TEST(Upsampling, TakesImagesOfOddSizesAndGrey)
{
  const cv::Mat image(17, 33, CV_8UC1, 90);
  const cv::Mat half(8, 16, CV_32FC1, -0.75F);
  ThreadPool pool(1);
  cv::Mat disparity;
  cv::Mat confidence;
  upsample(half, half, 0.2F, image, pool, disparity, confidence);
  EXPECT_EQ(cv::norm(disparity, cv::Mat(17, 33, CV_32FC1, -0.75F), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace light_field_depth::multiview
