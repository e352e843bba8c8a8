#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "light_field_depth/core/view_maps.h"

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

/// The reference and one view more. No calibration is needed.
LightField fieldWithView(const cv::Point2d& steps)
{
  LightField field;
  for (const cv::Point2d& place : {cv::Point2d(), steps})
  {
    View view;
    view.image = cv::Mat::zeros(30, 40, CV_8UC1);
    view.steps = place;
    field.views.push_back(view);
  }
  return field;
}

std::vector<ViewMap> mapsOf(const LightField& field, const std::vector<ViewDisparity>& solved)
{
  ThreadPool pool(2);
  std::vector<ViewMap> maps;
  viewMaps(
      field, solved, {}, pool,
      [&maps](const ViewMap& map) {
        maps.push_back({map.view_index, map.disparity.clone(), map.confidence.clone(), map.origin.clone()});
      });
  return maps;
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
                         ::testing::Values(cv::Point2d(2, 0), cv::Point2d(-3, 0), cv::Point2d(0, 2),
                                           cv::Point2d(0, -3), cv::Point2d(1, -2), cv::Point2d(-2, 1)));

TEST_P(ViewMaps, TakeTheNearestPixelAndFillTheRestFromTheBackground)
{
  const cv::Mat disparity = squareBeforeAWall();
  const auto maps =
      mapsOf(fieldWithView(GetParam()), {{0, disparity, cv::Mat::ones(disparity.size(), CV_32FC1)}});
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_EQ(cv::norm(maps[0].disparity, disparity, cv::NORM_INF), 0.0) << "the reference's own map";
  const cv::Mat expected = nearestArrivals(disparity, GetParam());
  for (int y = 0; y < expected.rows; ++y)
  {
    for (int x = 0; x < expected.cols; ++x)
    {
      const bool arrived = expected.at<float>(y, x) > 0.0F;
      ASSERT_NEAR(maps[1].disparity.at<float>(y, x), arrived ? expected.at<float>(y, x) : FAR_PX, 1e-5)
          << x << ' ' << y;
      ASSERT_EQ(maps[1].confidence.at<float>(y, x) > 0.0F, arrived) << x << ' ' << y;
      ASSERT_EQ(maps[1].origin.at<std::uint8_t>(y, x),
                static_cast<std::uint8_t>(arrived ? ViewPixel::Seen : ViewPixel::Filled))
          << x << ' ' << y;
    }
  }
}

TEST(ViewMapsAtTheEnds, HaveTheLowestDisparityInAViewThatSeesNothing)
{
  const cv::Mat disparity = squareBeforeAWall();
  const auto maps =
      mapsOf(fieldWithView({100, 0}), {{0, disparity, cv::Mat::ones(disparity.size(), CV_32FC1)}});
  EXPECT_EQ(cv::countNonZero(maps[1].disparity != FAR_PX), 0);
  EXPECT_EQ(cv::countNonZero(maps[1].confidence), 0);
}

TEST(ViewMapsOfSeveralSolvedOnes, HaveWhatTheReferenceDoesNotSee)
{
  // The view two steps to the right and the one beyond it look behind the square, and both know it.
  LightField field = fieldWithView({2, 0});
  field.views.push_back(field.views.back());
  field.views.back().steps = {3, 0};
  const cv::Mat reference = squareBeforeAWall();
  const auto shifted = [](int columns)
  {
    cv::Mat disparity(30, 40, CV_32FC1, cv::Scalar(FAR_PX));
    disparity(cv::Rect(15 - columns, 10, 10, 10)).setTo(NEAR_PX);
    return disparity;
  };
  const cv::Mat sure = cv::Mat::ones(reference.size(), CV_32FC1);
  const auto maps = mapsOf(field, {{0, reference, sure}, {1, shifted(6), sure}, {2, shifted(9), sure}});
  const int behind =
      20;  // column of the second view: the square is at 9..18, hidden from the reference are 19..22
  EXPECT_EQ(maps[1].origin.at<std::uint8_t>(15, behind), static_cast<std::uint8_t>(ViewPixel::Solved));
  EXPECT_FLOAT_EQ(maps[1].disparity.at<float>(15, behind), FAR_PX);
  EXPECT_GT(maps[1].confidence.at<float>(15, behind), 0.5F);
}

}  // namespace
}  // namespace light_field_depth
