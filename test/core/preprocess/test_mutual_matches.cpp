#include "core/preprocess/mutual_matches.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace light_field_depth
{
namespace
{
constexpr int WIDTH = 24;
constexpr int LABELS = 9;
constexpr std::uint16_t BAD = 100;

/// A pair in one row with half a pixel of displacement for each label.
PlaneSweep pairSweep()
{
  PlaneSweep sweep;
  sweep.reference = cv::Mat::zeros(1, WIDTH, CV_8UC1);
  sweep.arms = {{{sweep.reference, cv::Point2f(1.0F, 0.0F), cv::Point2f()}}};
  sweep.disparity_step = 0.5F;
  sweep.labels = LABELS;
  return sweep;
}

/// Each pixel matches at its own label only.
SweepCosts costsOf(const std::vector<int>& labels, const std::vector<std::uint16_t>& costs)
{
  SweepCosts volume;
  volume.labels = LABELS;
  volume.size = {WIDTH, 1};
  volume.values = cv::Mat(LABELS, WIDTH, CV_16UC1, cv::Scalar(BAD));
  for (std::size_t x = 0; x < labels.size(); ++x)
  {
    volume.cost(labels[x])[x] = costs[x];
  }
  return volume;
}

TEST(MutualMatches, AnEvenSurfaceMatchesBothWaysWhereTheOtherViewSeesIt)
{
  ThreadPool pool(1);
  const std::vector<std::uint8_t> mutual = findMutualMatches(
      pairSweep(), costsOf(std::vector<int>(WIDTH, 4), std::vector<std::uint16_t>(WIDTH, 0)), pool);
  for (std::size_t x = 0; x < mutual.size(); ++x)
  {
    EXPECT_EQ(mutual[x], x >= 2 ? 1 : 0) << x;  // label 4 is 2 pixels: the first two are outside of the view
  }
}

TEST(MutualMatches, APixelThatTheOtherViewCannotSeeIsNot)
{
  // The pixels from 12 on belong to a nearer surface, 4 pixels; those of 8 to 11 are hidden behind it and
  // find something there all the same, but at a higher cost.
  std::vector<int> labels(WIDTH, 0);
  std::vector<std::uint16_t> costs(WIDTH, 0);
  std::fill(labels.begin() + 12, labels.end(), 8);
  std::fill(costs.begin() + 8, costs.begin() + 12, 20);
  ThreadPool pool(1);
  const std::vector<std::uint8_t> mutual = findMutualMatches(pairSweep(), costsOf(labels, costs), pool);
  for (std::size_t x = 0; x < mutual.size(); ++x)
  {
    EXPECT_EQ(mutual[x], x < 8 || x >= 12 ? 1 : 0) << x;
  }
}

}  // namespace
}  // namespace light_field_depth
