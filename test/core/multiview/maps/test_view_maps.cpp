#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/maps/view_maps.h"

namespace light_field_depth
{
namespace
{
constexpr float NEAR_PX = 3.0F;
constexpr float FAR_PX = 1.0F;

/// A near square before a far wall, 40 x 30 pixels.
cv::Mat squareBeforeAWall()
{
  cv::Mat disparity(30, 40, CV_32FC1, cv::Scalar(FAR_PX));
  disparity(cv::Rect(15, 10, 10, 10)).setTo(NEAR_PX);
  return disparity;
}

LightField fieldWithSteps(const std::vector<cv::Point2d>& steps)
{
  LightField field;
  for (const cv::Point2d& step : steps)
  {
    View view;
    view.image = cv::Mat::zeros(30, 40, CV_8UC1);
    view.steps = step;
    field.views.push_back(view);
  }
  return field;
}

/// The definition, pixel by pixel: -1 where nothing arrives.
cv::Mat nearestArrivals(const cv::Mat& disparity, const cv::Point2d& steps)
{
  cv::Mat map(disparity.size(), CV_32FC1, cv::Scalar(-1.0F));
  for (int y = 0; y < disparity.rows; ++y)
  {
    for (int x = 0; x < disparity.cols; ++x)
    {
      const float d = disparity.at<float>(y, x);
      const auto to_x = static_cast<int>(std::floor(x + 0.5 - d * steps.x));
      const auto to_y = static_cast<int>(std::floor(y + 0.5 - d * steps.y));
      if (cv::Rect({}, disparity.size()).contains({to_x, to_y}))
      {
        map.at<float>(to_y, to_x) = std::max(map.at<float>(to_y, to_x), d);
      }
    }
  }
  return map;
}

class ViewMaps : public ::testing::TestWithParam<cv::Point2d>
{
};
INSTANTIATE_TEST_SUITE_P(Steps, ViewMaps,
                         ::testing::Values(cv::Point2d(0, 0), cv::Point2d(2, 0), cv::Point2d(-3, 0),
                                           cv::Point2d(0, 2), cv::Point2d(0, -3), cv::Point2d(1, -2),
                                           cv::Point2d(-2, 1), cv::Point2d(0.4, 0.7)));

TEST_P(ViewMaps, TakeTheNearestPixelAndFillTheRestFromTheBackground)
{
  const cv::Mat disparity = squareBeforeAWall();
  const cv::Mat confidence = cv::Mat::ones(disparity.size(), CV_32FC1);
  ThreadPool pool(2);
  std::vector<ViewDisparity> maps;
  multiview::warpToViews(fieldWithSteps({GetParam()}), disparity, confidence, pool, maps);
  const cv::Mat expected = nearestArrivals(disparity, GetParam());
  for (int y = 0; y < expected.rows; ++y)
  {
    for (int x = 0; x < expected.cols; ++x)
    {
      const bool arrived = expected.at<float>(y, x) > 0.0F;
      ASSERT_EQ(maps[0].disparity.at<float>(y, x), arrived ? expected.at<float>(y, x) : FAR_PX)
          << x << ' ' << y;
      ASSERT_EQ(maps[0].confidence.at<float>(y, x) > 0.0F, arrived) << x << ' ' << y;
    }
  }
}

TEST(ViewMapsAtTheEnds, HaveTheLowestDisparityInAViewThatSeesNothing)
{
  const cv::Mat disparity = squareBeforeAWall();
  ThreadPool pool(1);
  std::vector<ViewDisparity> maps;
  multiview::warpToViews(fieldWithSteps({{100, 0}, {0, 100}}), disparity,
                         cv::Mat::ones(disparity.size(), CV_32FC1), pool, maps);
  for (const ViewDisparity& map : maps)
  {
    EXPECT_EQ(cv::countNonZero(map.disparity != FAR_PX), 0);
    EXPECT_EQ(cv::countNonZero(map.confidence), 0);
  }
}

TEST(ViewMapsInAStream, LeaveMapsAloneThatSomebodyHolds)
{
  const cv::Mat disparity = squareBeforeAWall();
  const cv::Mat confidence = cv::Mat::ones(disparity.size(), CV_32FC1);
  const LightField field = fieldWithSteps({{1, 0}, {0, 1}});
  ThreadPool pool(1);
  std::vector<ViewDisparity> maps;
  multiview::warpToViews(field, disparity, confidence, pool, maps);
  const ViewDisparity held = maps[0];
  const cv::Mat copy = held.disparity.clone();
  const auto* const free_memory = maps[1].disparity.data;
  multiview::warpToViews(field, disparity * 2.0, confidence, pool, maps);
  EXPECT_EQ(cv::norm(held.disparity, copy, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(maps[0].disparity, copy, cv::NORM_INF), 0.0);
  EXPECT_EQ(maps[1].disparity.data, free_memory);
}

}  // namespace
}  // namespace light_field_depth
