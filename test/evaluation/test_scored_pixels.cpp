#include "evaluation/scored_pixels.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
constexpr float NOT_KNOWN = std::numeric_limits<float>::quiet_NaN();

std::string sentenceOf(const cv::Mat& result, const cv::Mat& truth, const cv::Mat& mask, int border_px)
{
  try
  {
    scorePixels(result, truth, mask, border_px);
  }
  catch (const InputError& error)
  {
    return error.what();
  }
  return "";
}

TEST(ScoredPixels, ErrorsAreAbsoluteAndInTheOrderOfTheRows)
{
  const cv::Mat truth = (cv::Mat_<float>(2, 2) << 1.0F, 2.0F, 3.0F, 4.0F);
  const cv::Mat result = (cv::Mat_<float>(2, 2) << 1.5F, 2.0F, 2.0F, 4.25F);
  const ScoredPixels scored = scorePixels(result, truth, {}, 0);
  EXPECT_EQ(scored.errors, (std::vector<float>{0.5F, 0.0F, 1.0F, 0.25F}));
  EXPECT_EQ(scored.positions[2], cv::Point(0, 1));
  EXPECT_EQ(scored.known, 4U);
}

TEST(ScoredPixels, APixelWithoutAValueIsOffByTheSpanOfTheTruthAndAtLeastByOne)
{
  const cv::Mat truth = (cv::Mat_<float>(1, 3) << -2.0F, 1.0F, NOT_KNOWN);
  const cv::Mat result = (cv::Mat_<float>(1, 3) << -2.0F, NOT_KNOWN, 7.0F);
  const ScoredPixels scored = scorePixels(result, truth, {}, 0);
  EXPECT_EQ(scored.errors, (std::vector<float>{0.0F, 3.0F}))
      << "where the truth is unknown nothing is scored";
  EXPECT_EQ(scored.known, 1U);
  const cv::Mat flat = (cv::Mat_<float>(1, 2) << 5.0F, 5.0F);
  const cv::Mat empty = (cv::Mat_<float>(1, 2) << NOT_KNOWN, 5.0F);
  EXPECT_EQ(scorePixels(empty, flat, {}, 0).errors[0], 1.0F);
}

TEST(ScoredPixels, ASmallerResultLiesInTheMiddleAndItsMarginCountsAsBorder)
{
  cv::Mat truth(6, 8, CV_32FC1);
  for (int i = 0; i < 48; ++i)
  {
    truth.ptr<float>()[i] = static_cast<float>(i);
  }
  const cv::Mat result = truth(cv::Rect(1, 1, 6, 4)).clone();
  const ScoredPixels scored = scorePixels(result, truth, {}, 2);
  ASSERT_EQ(scored.errors.size(), 8U) << "4 x 2";
  EXPECT_EQ(scored.positions.front(), cv::Point(1, 1));
  for (const float error : scored.errors)
  {
    EXPECT_EQ(error, 0.0F);
  }
}

TEST(ScoredPixels, TheMaskLeavesPixelsOut)
{
  const cv::Mat truth = cv::Mat::zeros(2, 2, CV_32FC1);
  const cv::Mat mask = (cv::Mat_<std::uint8_t>(2, 2) << 0, 1, 255, 0);
  EXPECT_EQ(scorePixels(truth, truth, mask, 0).errors.size(), 2U);
}

TEST(ScoredPixels, WhatDoesNotFitIsSaid)
{
  const cv::Mat small = cv::Mat::zeros(4, 5, CV_32FC1);
  const cv::Mat large = cv::Mat::zeros(6, 7, CV_32FC1);
  EXPECT_NE(sentenceOf(large, small, {}, 0).find("7 x 6 pixels and is larger than the truth with 5 x 4"),
            std::string::npos);
  EXPECT_NE(sentenceOf(small, large, cv::Mat::ones(4, 5, CV_8UC1), 0).find("The mask has 5 x 4"),
            std::string::npos);
  EXPECT_NE(sentenceOf(small, small, {}, 2).find("leaves nothing"), std::string::npos);
  EXPECT_NE(sentenceOf(small, small, {}, -1).find("between 0 and"), std::string::npos);
  EXPECT_NE(sentenceOf(small, small, cv::Mat::zeros(4, 5, CV_8UC1), 0).find("no pixel to score"),
            std::string::npos);
}

}  // namespace
}  // namespace light_field_depth
