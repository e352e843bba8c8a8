#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "light_field_depth/core/error.h"
#include "light_field_depth/evaluation/evaluation.h"

namespace light_field_depth
{
namespace
{
constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

TEST(Evaluation, MatchesFiguresThatWereWorkedOutByHand)
{
  // Errors 0, 0.02, 0.05, 0.5 and 2 (the span of the truth) for what is unknown.
  const cv::Mat truth = (cv::Mat_<float>(1, 5) << 0.0F, 1.0F, 2.0F, 1.0F, 0.0F);
  const cv::Mat result = (cv::Mat_<float>(1, 5) << 0.0F, 1.02F, 1.95F, 1.5F, NaN);
  const Evaluation evaluation = evaluate(result, truth, {}, 0);
  EXPECT_NEAR(evaluation.mse_100, 100.0 * (0.0004 + 0.0025 + 0.25 + 4.0) / 5, 1e-4);
  EXPECT_NEAR(evaluation.badpix_007, 40.0, 1e-9);
  EXPECT_NEAR(evaluation.badpix_003, 60.0, 1e-9);
  EXPECT_NEAR(evaluation.badpix_001, 80.0, 1e-9);
  EXPECT_NEAR(evaluation.q25, 2.0, 1e-4) << "the second smallest of five";
  EXPECT_NEAR(evaluation.coverage, 0.8, 1e-9);
}

TEST(Evaluation, InterpolatesTheQuantile)
{
  const cv::Mat truth = cv::Mat::zeros(1, 4, CV_32FC1);
  const cv::Mat result = (cv::Mat_<float>(1, 4) << 4.0F, -1.0F, 2.0F, 3.0F);
  EXPECT_NEAR(evaluate(result, truth, {}, 0).q25, 175.0, 1e-4) << "three quarters of the way from 1 to 2";
}

TEST(Evaluation, LeavesOutBorderMaskAndUnknownTruth)
{
  cv::Mat truth = cv::Mat::zeros(5, 6, CV_32FC1);
  cv::Mat result = cv::Mat::ones(5, 6, CV_32FC1);
  result(cv::Rect(1, 1, 4, 3)).setTo(0.0);
  EXPECT_EQ(evaluate(result, truth, {}, 1).badpix_007, 0.0);
  EXPECT_NEAR(evaluate(result, truth, {}, 0).badpix_007, 100.0 * 18 / 30, 1e-9);
  cv::Mat mask = cv::Mat::zeros(5, 6, CV_8UC1);
  mask.row(0).setTo(255);
  mask.at<std::uint8_t>(1, 1) = 1;
  EXPECT_NEAR(evaluate(result, truth, mask, 0).badpix_007, 100.0 * 6 / 7, 1e-9);
  truth.row(0).setTo(NaN);
  EXPECT_NEAR(evaluate(result, truth, {}, 0).badpix_007, 100.0 * 12 / 24, 1e-9);
}

TEST(Evaluation, CentresASmallerResult)
{
  cv::Mat truth(10, 12, CV_32FC1);
  for (int y = 0; y < truth.rows; ++y)
  {
    for (int x = 0; x < truth.cols; ++x)
    {
      truth.at<float>(y, x) = static_cast<float>(100 * y + x);
    }
  }
  const cv::Mat result = truth(cv::Rect(3, 1, 6, 8)).clone();
  EXPECT_EQ(evaluate(result, truth, {}, 0).mse_100, 0.0);
  EXPECT_EQ(evaluate(result, truth, {}, 4).mse_100, 0.0);
}

TEST(Evaluation, RefusesWhatDoesNotFit)
{
  const cv::Mat map = cv::Mat::zeros(8, 8, CV_32FC1);
  EXPECT_THROW(evaluate(cv::Mat::zeros(9, 8, CV_32FC1), map), InputError);
  EXPECT_THROW(evaluate(map, map, cv::Mat::ones(7, 8, CV_8UC1), 0), InputError);
  EXPECT_THROW(evaluate(map, map, cv::Mat::zeros(8, 8, CV_8UC1), 0), InputError);
  EXPECT_THROW(evaluate(map, map, {}, 4), InputError);
  EXPECT_THROW(evaluate(map, map, {}, -1), InputError);
  EXPECT_THROW(evaluate(map, map, {}, std::numeric_limits<int>::max()), InputError);
  EXPECT_THROW(evaluate(map, cv::Mat(8, 8, CV_32FC1, cv::Scalar(NaN)), {}, 0), InputError);
  EXPECT_NO_THROW(evaluate(map, map, {}, 3));
}

TEST(Evaluation, PrintsNamesAndFigures)
{
  Evaluation evaluation;
  evaluation.mse_100 = 1.23456;
  evaluation.badpix_007 = 12.0;
  evaluation.coverage = 1.0;
  EXPECT_EQ(
      toText(evaluation),
      "mse_100 1.235  badpix_007 12.000  badpix_003 0.000  badpix_001 0.000  q25 0.000  coverage 1.000");
  EXPECT_EQ(toJson(evaluation),
            "{\"mse_100\": 1.23456, \"badpix_007\": 12.0, \"badpix_003\": 0.0, "
            "\"badpix_001\": 0.0, \"q25\": 0.0, \"coverage\": 1.0}");
}

}  // namespace
}  // namespace light_field_depth
