#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/refine/known_around.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr float SURE = 50.0F;

/// A wall at -3 with a box at 2 on it, known in the left half of the image; the search ended at -9 in the
/// right one.
struct HalfBlank
{
  cv::Mat weight{200, 400, CV_32FC1, cv::Scalar(0.0F)};
  cv::Mat disparity{200, 400, CV_32FC1, cv::Scalar(-9.0F)};

  HalfBlank()
  {
    weight.colRange(0, 200).setTo(SURE);
    disparity.colRange(0, 200).setTo(-3.0F);
    disparity(cv::Rect(100, 50, 100, 100)).setTo(2.0F);
  }
};

TEST(KnownAround, LeavesWhatIsKnown)
{
  HalfBlank map;
  const cv::Mat before = map.disparity.clone();
  ThreadPool pool(2);
  bringToKnownAround(map.weight, pool, map.disparity);
  EXPECT_EQ(cv::norm(map.disparity.colRange(0, 200), before.colRange(0, 200), cv::NORM_INF), 0.0);
}

TEST(KnownAround, RaisesWhatTheSearchLeftBehindEverything)
{
  HalfBlank map;
  ThreadPool pool(2);
  bringToKnownAround(map.weight, pool, map.disparity);
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(map.disparity.colRange(200, 400), &low, &high);
  EXPECT_FLOAT_EQ(static_cast<float>(low), -3.0F);
  EXPECT_LE(high, 2.0);
  EXPECT_FLOAT_EQ(map.disparity.at<float>(10, 390), -3.0F) << "far from all that is known";
}

TEST(KnownAround, LowersWhatTheSearchLeftBeforeEverything)
{
  HalfBlank map;
  map.disparity.colRange(200, 400).setTo(7.0F);
  ThreadPool pool(2);
  bringToKnownAround(map.weight, pool, map.disparity);
  double high = 0.0;
  cv::minMaxLoc(map.disparity, nullptr, &high);
  EXPECT_FLOAT_EQ(static_cast<float>(high), 2.0F);
}

TEST(KnownAround, KeepsWhatLiesBetween)
{
  HalfBlank map;
  map.disparity.colRange(200, 400).setTo(-1.0F);
  const cv::Mat before = map.disparity.clone();
  ThreadPool pool(2);
  bringToKnownAround(map.weight, pool, map.disparity);
  const cv::Rect beside_box(200, 70, 20, 60);
  EXPECT_EQ(cv::norm(map.disparity(beside_box), before(beside_box), cv::NORM_INF), 0.0);
}

TEST(KnownAround, ChangesNothingWhereNothingIsKnown)
{
  HalfBlank map;
  map.weight.setTo(0.0F);
  const cv::Mat before = map.disparity.clone();
  ThreadPool pool(2);
  bringToKnownAround(map.weight, pool, map.disparity);
  EXPECT_EQ(cv::norm(map.disparity, before, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace light_field_depth::multiview
