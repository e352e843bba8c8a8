#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "core/multiview/maps/confidence_kernels.h"
#include "core/multiview/maps/window_extent_kernels.h"
#include "support/instruction_sets.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int WIDTH = 203;  // no multiple of any vector

cv::Mat randomMap(int height, int width, float low, float high)
{
  static std::mt19937 engine(23);
  std::uniform_real_distribution<float> distribution(low, high);
  cv::Mat map(height, width, CV_32FC1);
  std::generate(map.begin<float>(), map.end<float>(), [&] { return distribution(engine); });
  return map;
}

class ConfidenceKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, ConfidenceKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(ConfidenceKernels, WindowsEqualThePlainVersionAndMorphology)
{
  for (const int width : {1, 2, 3, 16, 33, WIDTH})
  {
    const cv::Mat map = randomMap(7, width, -3.0F, 3.0F);
    std::vector<float> scratch(extentScratch(width));
    for (int radius = 1; radius <= ExtentRow::MAX_RADIUS; ++radius)
    {
      cv::Mat lowest;
      cv::Mat highest;
      const cv::Mat window = cv::Mat::ones(2 * radius + 1, 2 * radius + 1, CV_8UC1);
      cv::erode(map, lowest, window);
      cv::dilate(map, highest, window);
      for (int y = 0; y < map.rows; ++y)
      {
        cv::Mat results[4];
        std::generate(std::begin(results), std::end(results), [&] { return cv::Mat(1, width, CV_32FC1); });
        ExtentRow row = extentRowOf(map, y, radius);
        row.columns = scratch.data();
        row.low = results[0].ptr<float>();
        row.high = results[1].ptr<float>();
        findExtents(row);
        row.low = results[2].ptr<float>();
        row.high = results[3].ptr<float>();
        findExtentsPlain(row);
        EXPECT_EQ(cv::norm(results[0], results[2], cv::NORM_INF), 0.0);
        EXPECT_EQ(cv::norm(results[1], results[3], cv::NORM_INF), 0.0);
        EXPECT_EQ(cv::norm(results[0], lowest.row(y), cv::NORM_INF), 0.0) << width << ", row " << y;
        EXPECT_EQ(cv::norm(results[1], highest.row(y), cv::NORM_INF), 0.0) << width << ", row " << y;
      }
    }
  }
}

/// Evidence of a row that varies so far that every limit is met.
struct Evidence
{
  cv::Mat maps = randomMap(11, WIDTH, -0.3F, 0.5F);
  cv::Mat weight = randomMap(1, WIDTH, 0.0F, 400.0F);
  cv::Mat residual = randomMap(1, WIDTH, 0.0F, 90.0F);
  EvidenceRow row;

  Evidence()
  {
    row.disparity = maps.ptr<float>(0);
    row.searched = maps.ptr<float>(1);
    row.first_search = maps.ptr<float>(2);
    row.target = maps.ptr<float>(3);
    row.weight = weight.ptr<float>();
    row.disagreement = maps.ptr<float>(4);
    row.residual = residual.ptr<float>();
    row.low = maps.ptr<float>(5);
    row.high = maps.ptr<float>(6);
    row.wide_low = maps.ptr<float>(7);
    row.wide_high = maps.ptr<float>(8);
    row.noise_sigma = 3.0F;
    row.width = WIDTH;
  }
};

TEST_P(ConfidenceKernels, WeighedEvidenceEqualsThePlainVersion)
{
  const Evidence evidence;
  std::vector<float> simd(WIDTH);
  std::vector<float> plain(WIDTH);
  weighEvidence(evidence.row, simd.data());
  weighEvidencePlain(evidence.row, plain.data());
  EXPECT_EQ(simd, plain);
}

TEST_P(ConfidenceKernels, EveryPieceOfEvidenceSpeaksAgainstTheDisparity)
{
  const std::vector<float> nothing(WIDTH, 0.0F);
  const std::vector<float> something(WIDTH, 0.2F);
  const std::vector<float> much(WIDTH, 100.0F);
  EvidenceRow good;
  for (const float** map :
       {&good.disparity, &good.searched, &good.first_search, &good.target, &good.disagreement, &good.residual,
        &good.low, &good.high, &good.wide_low, &good.wide_high})
  {
    *map = nothing.data();
  }
  good.weight = much.data();
  good.width = WIDTH;
  std::vector<float> best(WIDTH);
  weighEvidence(good, best.data());
  const auto worse = [&](const float* EvidenceRow::*map, const std::vector<float>& values)
  {
    EvidenceRow row = good;
    row.*map = values.data();
    std::vector<float> against(WIDTH);
    weighEvidence(row, against.data());
    return against[WIDTH - 1] > best[WIDTH - 1];
  };
  EXPECT_TRUE(worse(&EvidenceRow::high, something));
  EXPECT_TRUE(worse(&EvidenceRow::wide_high, something));
  EXPECT_TRUE(worse(&EvidenceRow::weight, nothing));
  EXPECT_TRUE(worse(&EvidenceRow::disagreement, something));
  EXPECT_TRUE(worse(&EvidenceRow::target, something));
  EXPECT_TRUE(worse(&EvidenceRow::searched, something));
  EXPECT_TRUE(worse(&EvidenceRow::first_search, something));
  EXPECT_TRUE(worse(&EvidenceRow::residual, much));
}

}  // namespace
}  // namespace light_field_depth::multiview
