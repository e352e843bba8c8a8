#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/paper2017/disparity_fusion.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
constexpr float MISSING = std::numeric_limits<float>::quiet_NaN();

View viewAt(double x, double y)
{
  View view;
  view.steps = {x, y};
  return view;
}

DenseDisparity constant(const cv::Size& size, float disparity)
{
  return {cv::Mat(size, CV_32FC1, cv::Scalar(disparity)), cv::Mat::ones(size, CV_32FC1)};
}

TEST(DisparityFusion, BringsTheMapOfAnotherViewToTheReference)
{
  const cv::Size size(128, 96);
  const auto scene = testing::standardScene(size);
  const cv::Mat truth = testing::renderTruth(scene, size, {0, 0});
  for (const cv::Point2d steps : {cv::Point2d(3, 0), cv::Point2d(0, -2), cv::Point2d(-4, 0)})
  {
    const DenseDisparity map{testing::renderTruth(scene, size, steps), cv::Mat::ones(size, CV_32FC1)};
    const DenseDisparity warped = warpToReference(map, viewAt(steps.x, steps.y));
    int wrong = 0;
    int missing = 0;
    for (int y = 12; y < size.height - 12; ++y)
    {
      for (int x = 12; x < size.width - 12; ++x)
      {
        const float value = warped.disparity.at<float>(y, x);
        missing += std::isfinite(value) ? 0 : 1;
        wrong += std::abs(value - truth.at<float>(y, x)) > 0.1F ? 1 : 0;
      }
    }
    EXPECT_LT(missing, 900) << steps;
    EXPECT_LT(wrong, 300) << steps;
  }
}

TEST(DisparityFusion, LetsTheNearestSurfaceWin)
{
  DenseDisparity map = constant({20, 4}, 0.0F);
  map.disparity.at<float>(2, 10) = 3.0F;
  const DenseDisparity warped = warpToReference(map, viewAt(1, 0));
  EXPECT_FLOAT_EQ(warped.disparity.at<float>(2, 13), 3.0F);
  EXPECT_TRUE(std::isnan(warped.disparity.at<float>(2, 10)));
  const DenseDisparity away = warpFromReference(map, viewAt(1, 0));
  EXPECT_FLOAT_EQ(away.disparity.at<float>(2, 7), 3.0F);
}

TEST(DisparityFusion, CountsTheOffsetOfAView)
{
  DenseDisparity map = constant({20, 20}, MISSING);
  map.confidence.setTo(0.0);
  map.disparity.at<float>(10, 10) = 2.0F;
  map.confidence.at<float>(10, 10) = 1.0F;
  View view = viewAt(2, 0);
  view.offset_px = {1.0, -3.0};
  EXPECT_FLOAT_EQ(warpToReference(map, view).disparity.at<float>(13, 13), 2.0F);
}

TEST(DisparityFusion, TakesTheMedianAndKnowsHowWellTheMapsAgree)
{
  const cv::Size size(8, 8);
  ThreadPool pool(2);
  const FusedDisparity odd = fuseByMedian({constant(size, 1), constant(size, 9), constant(size, 2)}, pool);
  EXPECT_FLOAT_EQ(odd.disparity.at<float>(3, 3), 2.0F);
  const FusedDisparity even = fuseByMedian({constant(size, 1), constant(size, 2)}, pool);
  EXPECT_FLOAT_EQ(even.disparity.at<float>(3, 3), 1.5F);
  const FusedDisparity same = fuseByMedian({constant(size, 1), constant(size, 1)}, pool);
  EXPECT_FLOAT_EQ(same.confidence.at<float>(3, 3), 1.0F);
  EXPECT_LT(even.confidence.at<float>(3, 3), 0.1F);
  EXPECT_FLOAT_EQ(fuseByMedian({constant(size, 1), constant(size, MISSING)}, pool).confidence.at<float>(3, 3),
                  0.5F);
}

TEST(DisparityFusion, FillsWhatNoMapKnows)
{
  DenseDisparity map = constant({10, 6}, 4.0F);
  map.disparity.colRange(0, 5).setTo(MISSING);
  ThreadPool pool(1);
  const FusedDisparity fused = fuseByMedian({map}, pool);
  EXPECT_FLOAT_EQ(fused.disparity.at<float>(3, 0), 4.0F);
  EXPECT_FLOAT_EQ(fused.confidence.at<float>(3, 0), 0.0F);
  const FusedDisparity unknown = fuseByMedian({constant({10, 6}, MISSING)}, pool);
  EXPECT_FLOAT_EQ(unknown.disparity.at<float>(3, 0), 0.0F);
}

}  // namespace
}  // namespace light_field_depth
