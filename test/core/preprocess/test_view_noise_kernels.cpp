#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/preprocess/view_noise_kernels.h"
#include "support/instruction_sets.h"

namespace light_field_depth
{
namespace
{
class ViewNoiseKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, ViewNoiseKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(ViewNoiseKernels, EqualThePlainVersions)
{
  cv::Mat images[2];
  cv::RNG random(3);
  for (const int spread : {20, 255})
  {
    for (cv::Mat& image : images)
    {
      image.create(20, 60, CV_8UC1);
      random.fill(image, cv::RNG::UNIFORM, 0, spread + 1);
    }
    const BlockPair pair{images[0].ptr(5) + 7, 60, images[1].ptr(6) + 11, 60};
    for (const int bytes : {NOISE_BLOCK_PX, MAX_NOISE_BLOCK_BYTES})
    {
      const DifferenceSums simd = sumDifferences(pair, bytes);
      const DifferenceSums plain = sumDifferencesPlain(pair, bytes);
      EXPECT_EQ(simd.squares, plain.squares);
      EXPECT_EQ(std::vector<int>(simd.columns, simd.columns + bytes),
                std::vector<int>(plain.columns, plain.columns + bytes));
    }
    EXPECT_EQ(sumSlopes(pair), sumSlopesPlain(pair));
  }
}

}  // namespace
}  // namespace light_field_depth
