#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/search/median_kernels.h"
#include "support/instruction_sets.h"

namespace light_field_depth::multiview
{
namespace
{
cv::Mat randomLabels(int height, int width, bool whole)
{
  static std::mt19937 engine(9);
  std::uniform_real_distribution<float> distribution(0.0F, 8.0F);
  cv::Mat labels(height, width, CV_32FC1);
  std::generate(labels.begin<float>(), labels.end<float>(),
                [&]
                { return whole ? static_cast<float>(cvRound(distribution(engine))) : distribution(engine); });
  return labels;
}

MedianRow rowAbout(const cv::Mat& labels, int y, std::vector<float>& scratch, std::vector<float>& medians)
{
  MedianRow row;
  for (int i = 0; i < MEDIAN_SIZE; ++i)
  {
    row.rows[static_cast<std::size_t>(i)] = labels.ptr<float>(std::clamp(y + i - 2, 0, labels.rows - 1));
  }
  row.width = labels.cols;
  row.scale = 0.3F;
  row.offset = -1.7F;
  scratch.resize(medianScratch(labels.cols));
  medians.resize(static_cast<std::size_t>(labels.cols));
  row.sorted_columns = scratch.data();
  row.medians = medians.data();
  return row;
}

class Median : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, Median, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(Median, VectorsEqualThePlainVersion)
{
  std::vector<float> scratch;
  std::vector<float> simd;
  std::vector<float> plain;
  for (const int width : {1, 2, 3, 4, 5, 16, 17, 203})
  {
    for (const bool whole : {false, true})
    {
      const cv::Mat labels = randomLabels(9, width, whole);
      for (int y = 0; y < labels.rows; ++y)
      {
        medianRow(rowAbout(labels, y, scratch, simd));
        medianRowPlain(rowAbout(labels, y, scratch, plain));
        ASSERT_EQ(simd, plain) << "width " << width << ", row " << y;
      }
    }
  }
}

/// All windows of zeros and ones, but for the order within a column: what selects the median of all of them
/// selects that of any numbers.
TEST_P(Median, SelectsTheMedianOfEveryWindowOfZerosAndOnes)
{
  constexpr int kinds = MEDIAN_SIZE + 1;  // of columns
  constexpr int windows = kinds * kinds * kinds * kinds * kinds;
  cv::Mat labels(MEDIAN_SIZE, windows * MEDIAN_SIZE, CV_32FC1);
  for (int x = 0; x < labels.cols; ++x)
  {
    int ones = x / MEDIAN_SIZE;
    for (int column = 0; column < x % MEDIAN_SIZE; ++column)
    {
      ones /= kinds;
    }
    for (int y = 0; y < MEDIAN_SIZE; ++y)
    {
      labels.at<float>(y, x) = y < ones % kinds ? 1.0F : 0.0F;
    }
  }
  std::vector<float> scratch;
  std::vector<float> simd;
  std::vector<float> plain;
  medianRow(rowAbout(labels, 2, scratch, simd));
  medianRowPlain(rowAbout(labels, 2, scratch, plain));
  EXPECT_EQ(simd, plain);
}

}  // namespace
}  // namespace light_field_depth::multiview
