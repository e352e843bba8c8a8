#include <gtest/gtest.h>

#include "core/paper2017/feature_flow.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
SparseDisparity nothing(const cv::Size& size)
{
  return {cv::Mat::zeros(size, CV_32FC1), cv::Mat::zeros(size, CV_32FC1)};
}

SparseDisparity everywhere(const cv::Size& size, float disparity)
{
  return {cv::Mat(size, CV_32FC1, cv::Scalar(disparity)), cv::Mat::ones(size, CV_32FC1)};
}

std::vector<View> greyViews(int count, const cv::Size& size)
{
  std::vector<View> views;
  for (int i = 0; i < count; ++i)
  {
    views.push_back(gridView(0, i, cv::Mat(size, CV_8UC1, cv::Scalar(100))));
  }
  return views;
}

std::vector<const View*> pointers(const std::vector<View>& views)
{
  std::vector<const View*> result;
  for (const View& view : views)
  {
    result.push_back(&view);
  }
  return result;
}

TEST(FeatureFlow, CarriesAMatchAlongItsPathToAViewThatHasNone)
{
  const cv::Size size(24, 16);
  const auto views = greyViews(3, size);
  ThreadPool pool(2);
  std::vector<SparseDisparity> estimates = {everywhere(size, 1.0F), nothing(size), nothing(size)};
  const std::vector<SparseDisparity> forward = {everywhere(size, 1.0F), everywhere(size, 1.0F),
                                                nothing(size)};
  const std::vector<SparseDisparity> backward(3, nothing(size));
  const auto dense = featureFlow(pointers(views), estimates, forward, backward, {}, pool);
  EXPECT_NEAR(dense[2].disparity.at<float>(8, 10), 1.0F, 1e-3F);
  EXPECT_GT(dense[2].confidence.at<float>(8, 10), 0.3F);
  FeatureFlowOptions spatial_only;
  spatial_only.angular = false;
  const auto alone = featureFlow(pointers(views), estimates, forward, backward, spatial_only, pool);
  EXPECT_FLOAT_EQ(alone[2].confidence.at<float>(8, 10), 0.0F);
}

TEST(FeatureFlow, FillsUnmatchedPixelsFromTheirOwnSideOfAnEdge)
{
  const cv::Size size(40, 20);
  auto views = greyViews(2, size);
  SparseDisparity estimate = nothing(size);
  for (View& view : views)
  {
    view.image.colRange(20, 40).setTo(220);
  }
  estimate.disparity.colRange(0, 20).setTo(-1.0);
  estimate.disparity.colRange(20, 40).setTo(2.0);
  estimate.confidence.colRange(2, 6).setTo(1.0);
  estimate.confidence.colRange(34, 38).setTo(1.0);
  ThreadPool pool(1);
  const std::vector<SparseDisparity> none(2, nothing(size));
  const auto dense = featureFlow(pointers(views), {estimate, estimate}, none, none, {}, pool);
  EXPECT_NEAR(dense[0].disparity.at<float>(10, 18), -1.0F, 0.01F);
  EXPECT_NEAR(dense[0].disparity.at<float>(10, 21), 2.0F, 0.01F);
}

TEST(FeatureFlow, SwitchedOffTakesTheNearestMatch)
{
  const cv::Size size(30, 10);
  const auto views = greyViews(2, size);
  SparseDisparity estimate = nothing(size);
  estimate.disparity.at<float>(5, 3) = -2.0F;
  estimate.confidence.at<float>(5, 3) = 1.0F;
  estimate.disparity.at<float>(5, 25) = 4.0F;
  estimate.confidence.at<float>(5, 25) = 1.0F;
  FeatureFlowOptions off;
  off.enabled = false;
  ThreadPool pool(1);
  const std::vector<SparseDisparity> none(2, nothing(size));
  const auto dense = featureFlow(pointers(views), {estimate, estimate}, none, none, off, pool);
  EXPECT_FLOAT_EQ(dense[0].disparity.at<float>(2, 8), -2.0F);
  EXPECT_FLOAT_EQ(dense[0].disparity.at<float>(9, 20), 4.0F);
}

TEST(FeatureFlow, StaysFiniteWithoutAnyMatch)
{
  const cv::Size size(30, 20);
  const auto views = greyViews(2, size);
  const std::vector<SparseDisparity> none(2, nothing(size));
  ThreadPool pool(1);
  for (const bool enabled : {true, false})
  {
    FeatureFlowOptions options;
    options.enabled = enabled;
    const auto dense = featureFlow(pointers(views), none, none, none, options, pool);
    EXPECT_TRUE(cv::checkRange(dense[1].disparity));
    EXPECT_EQ(cv::countNonZero(dense[1].confidence), 0);
  }
}

}  // namespace
}  // namespace light_field_depth
