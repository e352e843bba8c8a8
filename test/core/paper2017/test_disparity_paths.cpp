#include "core/paper2017/disparity_paths.h"

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
/// Of one view, and where it is known.
struct Disparities
{
  cv::Mat disparity;
  cv::Mat confidence;
};

Disparities nothing(const cv::Size& size)
{
  return {cv::Mat::zeros(size, CV_32FC1), cv::Mat::zeros(size, CV_32FC1)};
}

Disparities everywhere(const cv::Size& size, float disparity)
{
  return {cv::Mat(size, CV_32FC1, cv::Scalar(disparity)), cv::Mat::ones(size, CV_32FC1)};
}

TEST(DisparityPaths, FollowTheFlowAndLetTheNearestSurfaceKeepItsPath)
{
  const cv::Size size(16, 4);
  Disparities forward = nothing(size);
  forward.disparity.at<float>(1, 9) = 3.0F;  // to x = 6
  forward.confidence.at<float>(1, 9) = 1.0F;
  forward.disparity.at<float>(1, 5) = -1.0F;  // to x = 6 as well, hidden by the other
  forward.confidence.at<float>(1, 5) = 1.0F;
  const Disparities backward = nothing(size);
  const PathLinks links = linkPaths({{1.0, 0.0}, {}}, forward.disparity, forward.confidence,
                                    backward.disparity, backward.confidence);
  EXPECT_EQ(links.predecessor[16 + 6], 16 + 9);
  EXPECT_EQ(links.successor[16 + 9], 16 + 6);
  EXPECT_EQ(links.successor[16 + 5], PathLinks::NONE);
}

TEST(DisparityPaths, JoinHomelessPixelsByTheirBackwardMatch)
{
  const cv::Size size(16, 4);
  const Disparities forward = nothing(size);
  const Disparities backward = everywhere(size, 2.0F);
  const PathLinks links = linkPaths({{0.0, 1.0}, {}}, forward.disparity, forward.confidence,
                                    backward.disparity, backward.confidence);
  EXPECT_EQ(links.predecessor[0 * 16 + 3], 2 * 16 + 3);
  EXPECT_EQ(links.successor[2 * 16 + 3], 0 * 16 + 3);
  EXPECT_EQ(links.predecessor[2 * 16 + 3], PathLinks::NONE);
}

TEST(DisparityPaths, EndWhereTheyLeaveTheView)
{
  const cv::Size size(16, 4);
  const Disparities forward = everywhere(size, 3.0F);
  const Disparities backward = nothing(size);
  const PathLinks links = linkPaths({{1.0, 0.0}, {0.0, 1.0}}, forward.disparity, forward.confidence,
                                    backward.disparity, backward.confidence);
  EXPECT_EQ(links.successor[0 * 16 + 2], PathLinks::NONE) << "2 - 3 is outside";
  EXPECT_EQ(links.successor[0 * 16 + 3], 1 * 16 + 0) << "one row below, as the offset says";
  EXPECT_EQ(links.successor[3 * 16 + 9], PathLinks::NONE) << "there is no row below";
  EXPECT_EQ(links.predecessor[1 * 16 + 0], 0 * 16 + 3);
}

}  // namespace
}  // namespace light_field_depth
