#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/maps/confidence_kernels.h"
#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
using testing::randomMap;

constexpr int WIDTH = 203;  // no multiple of any vector

class ConfidenceKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, ConfidenceKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

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
