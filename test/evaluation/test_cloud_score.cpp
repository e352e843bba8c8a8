#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "light_field_depth/core/error.h"
#include "light_field_depth/evaluation/cloud_score.h"

namespace light_field_depth
{
namespace
{
constexpr int WIDTH = 60;
constexpr int HEIGHT = 40;
constexpr float FRONT_PX = 4.0F;  // f B / Z: 100 * 0.1 / 2.5 m
constexpr float BACK_PX = 2.0F;   // 5 m

/// A wall at 5 m, and in the middle of the image a board at 2.5 m, 20 pixels wide.
CloudTruth boardBeforeAWall()
{
  CloudTruth truth;
  truth.calibration.focal_length_px = 100.0;
  truth.calibration.principal_point_px = {29.5, 19.5};
  truth.calibration.baseline_m = 0.1;
  const auto add = [&](const cv::Point2d& steps, int first_column)
  {
    cv::Mat disparity(HEIGHT, WIDTH, CV_32FC1, cv::Scalar(BACK_PX));
    disparity.colRange(first_column, first_column + 20).setTo(FRONT_PX);
    truth.views.push_back({steps, {}, disparity});
  };
  add({0.0, 0.0}, 20);
  add({2.0, 0.0}, 12);  // two steps to the right: the board moves by 8 pixels, the wall by 4
  return truth;
}

/// The pixels of the reference's columns as points, their depth times a factor.
std::vector<cv::Point3f> pointsOf(const CloudTruth& truth, int first_column, int last_column,
                                  float factor = 1.0F)
{
  std::vector<cv::Point3f> points;
  for (int y = 0; y < HEIGHT; ++y)
  {
    for (int x = first_column; x < last_column; ++x)
    {
      const float z = factor * 10.0F / truth.views.front().disparity.at<float>(y, x);
      points.emplace_back((static_cast<float>(x) - 29.5F) / 100.0F * z,
                          (static_cast<float>(y) - 19.5F) / 100.0F * z, z);
    }
  }
  return points;
}

TEST(CloudScore, GivesFullMarksToWhatTheReferenceTrulySees)
{
  const CloudTruth truth = boardBeforeAWall();
  ThreadPool pool(2);
  const CloudScore score = scoreCloud(pointsOf(truth, 0, WIDTH), truth, pool);
  EXPECT_EQ(score.points, static_cast<std::size_t>(WIDTH * HEIGHT));
  EXPECT_EQ(score.surface_elements, static_cast<std::size_t>(WIDTH * HEIGHT));
  EXPECT_EQ(score.accuracy_025, 100.0);
  EXPECT_EQ(score.off_2, 0.0);
  EXPECT_EQ(score.flying, 0.0);
  EXPECT_EQ(score.completeness_025, 100.0);
  // To the right of the board the view on the right sees a strip of the wall that the board hides from the
  // reference, and another strip beyond the reference's image. The first is 4 pixels wide and only its ends
  // have points near them.
  EXPECT_LT(score.hidden_2, 60.0);
}

TEST(CloudScore, MeasuresErrorsInPartsOfTheDepth)
{
  const CloudTruth truth = boardBeforeAWall();
  ThreadPool pool(1);
  const CloudScore half_a_percent = scoreCloud(pointsOf(truth, 0, WIDTH, 1.005F), truth, pool);
  EXPECT_EQ(half_a_percent.accuracy_025, 0.0);
  EXPECT_EQ(half_a_percent.accuracy_1, 100.0);
  EXPECT_EQ(half_a_percent.completeness_025, 0.0);
  EXPECT_EQ(half_a_percent.completeness_1, 100.0);
  const CloudScore three_percent = scoreCloud(pointsOf(truth, 0, WIDTH, 1.03F), truth, pool);
  EXPECT_EQ(three_percent.off_2, 100.0);
  EXPECT_EQ(three_percent.completeness_2, 0.0);
}

TEST(CloudScore, TellsFlyingPointsFromOtherErrors)
{
  const CloudTruth truth = boardBeforeAWall();
  ThreadPool pool(1);
  std::vector<cv::Point3f> points = pointsOf(truth, 0, WIDTH);
  const std::size_t right = points.size();
  points.emplace_back(-10.0F / 100.0F * 3.5F, 0.0F,
                      3.5F);              // over the left rim of the board, half way to the wall
  points.emplace_back(0.0F, 0.0F, 3.5F);  // behind the middle of the board
  const CloudScore score = scoreCloud(points, truth, pool);
  const double one = 100.0 / static_cast<double>(right + 2);
  EXPECT_NEAR(score.off_2, 2 * one, 1e-9);
  EXPECT_NEAR(score.flying, one, 1e-9);
}

TEST(CloudScore, KnowsWhatIsHiddenFromTheReference)
{
  const CloudTruth truth = boardBeforeAWall();
  const cv::Mat hidden = hiddenFromReference(truth, 1);
  // In the right view: wall pixels 32..35 lie behind the board's columns 36..39 of the reference, and those
  // from 56 on beyond its last column.
  for (int x = 0; x < WIDTH; ++x)
  {
    const bool expected = (x >= 32 && x < 36) || x >= 56;
    EXPECT_EQ(hidden.at<std::uint8_t>(10, x) != 0, expected) << x;
  }
}

TEST(CloudScore, RefusesWhatCannotBeScored)
{
  CloudTruth truth = boardBeforeAWall();
  ThreadPool pool(1);
  EXPECT_THROW(scoreCloud({}, truth, pool), InputError);
  EXPECT_THROW(scoreCloud({{0.0F, 0.0F, -1.0F}}, truth, pool), InputError);
  truth.views.front().disparity.setTo(std::nanf(""));
  EXPECT_THROW(scoreCloud({{0.0F, 0.0F, 1.0F}}, truth, pool), InputError);
}

TEST(CloudScore, SaysSoInTextAndJson)
{
  const CloudTruth truth = boardBeforeAWall();
  ThreadPool pool(1);
  const CloudScore score = scoreCloud(pointsOf(truth, 0, WIDTH), truth, pool);
  EXPECT_NE(toText(score).find("accuracy_025 100.000"), std::string::npos);
  EXPECT_NE(toJson(score).find("\"completeness_025\":100.0"), std::string::npos);
}

}  // namespace
}  // namespace light_field_depth
