#include <gtest/gtest.h>

#include <cmath>

#include "core/paper2017/patch_match.h"

namespace light_field_depth
{
namespace
{
const cv::Size SIZE(60, 48);
constexpr int SPACING_PX = 3;

/// Seeds on a lattice that all found one disparity.
SeedMatches seeds(float disparity)
{
  SeedMatches matches;
  for (int x = 1; x < SIZE.width; x += SPACING_PX)
  {
    matches.columns_px.push_back(x);
  }
  for (int y = 1; y < SIZE.height; y += SPACING_PX)
  {
    matches.rows_px.push_back(y);
  }
  const cv::Size lattice(static_cast<int>(matches.columns_px.size()),
                         static_cast<int>(matches.rows_px.size()));
  matches.disparity = cv::Mat(lattice, CV_32FC1, cv::Scalar(disparity));
  matches.cost = cv::Mat::zeros(lattice, CV_32FC1);
  matches.centre_share = cv::Mat(lattice, CV_32FC1, cv::Scalar(0.8));
  return matches;
}

const ViewPair NEIGHBOURS = {{1.0, 0.0}, {}};

SparseDisparity checked(const SeedMatches& there, const SeedMatches& back, const ViewPair& pair = NEIGHBOURS,
                        PatchMatchOptions options = {})
{
  options.grid_spacing_px = SPACING_PX;
  return consistentMatches(there, back, pair, SIZE, options);
}

TEST(MatchConsistency, AMatchIsDrawnAsABlockWithTheWeightOfItsDisagreement)
{
  const SparseDisparity agreeing = checked(seeds(2.0F), seeds(2.0F));
  EXPECT_FLOAT_EQ(agreeing.disparity.at<float>(20, 30), 2.0F);
  EXPECT_FLOAT_EQ(agreeing.confidence.at<float>(20, 30), 0.8F);
  EXPECT_FLOAT_EQ(agreeing.confidence.at<float>(21, 31), 0.8F) << "the whole block";
  const SparseDisparity apart = checked(seeds(2.0F), seeds(2.4F));
  EXPECT_NEAR(apart.confidence.at<float>(20, 30), 0.8F * std::exp(-0.5F), 1e-5F) << "one standard deviation";
  PatchMatchOptions paper;
  paper.weigh_by_centre = false;
  EXPECT_FLOAT_EQ(checked(seeds(2.0F), seeds(2.0F), NEIGHBOURS, paper).confidence.at<float>(20, 30), 1.0F);
}

TEST(MatchConsistency, AMatchThatComesBackElsewhereIsDropped)
{
  EXPECT_EQ(cv::countNonZero(checked(seeds(2.0F), seeds(3.1F)).confidence), 0);
  // The threshold is in pixels: with views four steps apart a quarter of the disparity is too much.
  EXPECT_EQ(cv::countNonZero(checked(seeds(1.0F), seeds(1.3F), {{4.0, 0.0}, {}}).confidence), 0);
  EXPECT_GT(cv::countNonZero(checked(seeds(1.0F), seeds(1.3F)).confidence), 0);
}

TEST(MatchConsistency, AMatchThatEndsOutsideIsDropped)
{
  const SparseDisparity sparse = checked(seeds(6.0F), seeds(6.0F));
  EXPECT_EQ(sparse.confidence.at<float>(20, 7), 0.0F) << "7 - 6 is within the border of two pixels";
  EXPECT_GT(sparse.confidence.at<float>(20, 10), 0.0F);
  EXPECT_EQ(sparse.disparity.at<float>(20, 7), 0.0F);
}

TEST(MatchConsistency, SmallRegionsOfMatchesAreDropped)
{
  // 20 x 16 seeds: a twentieth are 16.
  SeedMatches there = seeds(0.0F);
  SeedMatches back = seeds(0.0F);
  for (SeedMatches* const matches : {&there, &back})
  {
    matches->disparity(cv::Rect(5, 5, 5, 3)).setTo(1.9);
    matches->disparity(cv::Rect(12, 5, 4, 4)).setTo(1.9);
  }
  const SparseDisparity sparse = checked(there, back);
  EXPECT_EQ(sparse.confidence.at<float>(19, 22), 0.0F) << "15 seeds";
  EXPECT_GT(sparse.confidence.at<float>(19, 40), 0.0F) << "16 seeds";
}

TEST(MatchConsistency, ASeedThatSaysNothingIsDropped)
{
  SeedMatches there = seeds(2.0F);
  there.centre_share.at<float>(6, 9) = 0.0F;
  const SparseDisparity sparse = checked(there, seeds(2.0F));
  EXPECT_EQ(sparse.confidence.at<float>(19, 28), 0.0F);
  EXPECT_GT(sparse.confidence.at<float>(19, 31), 0.0F);
}

}  // namespace
}  // namespace light_field_depth
