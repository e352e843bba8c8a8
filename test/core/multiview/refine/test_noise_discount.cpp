#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/refine/noise_discount.h"
#include "core/multiview/refine/noise_discount_kernels.h"
#include "support/instruction_sets.h"

namespace light_field_depth::multiview
{
namespace
{
std::vector<float> randomRow(int count, float low, float high)
{
  static std::mt19937 engine(4);
  std::uniform_real_distribution<float> distribution(low, high);
  std::vector<float> row(static_cast<std::size_t>(count));
  std::generate(row.begin(), row.end(), [&] { return distribution(engine); });
  return row;
}

class NoiseDiscountKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, NoiseDiscountKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(NoiseDiscountKernels, EqualThePlainVersions)
{
  for (const int width : {1, 7, 32, 67})
  {
    const auto curvature = randomRow(width, 0.0F, 30.0F);
    const auto noise = randomRow(width, 0.0F, 10.0F);
    const auto share = randomRow(width, 0.0F, 1.0F);
    auto sums = randomRow(width, 0.0F, 5.0F);
    auto noise_sums = randomRow(width, 0.0F, 5.0F);
    auto plain_sums = sums;
    auto plain_noise_sums = noise_sums;
    addCapped(curvature.data(), noise.data(), width, sums.data(), noise_sums.data());
    addCappedPlain(curvature.data(), noise.data(), width, plain_sums.data(), plain_noise_sums.data());
    EXPECT_EQ(sums, plain_sums);
    EXPECT_EQ(noise_sums, plain_noise_sums);
    auto values = curvature;
    auto plain_values = curvature;
    DiscountRow row{noise.data(), share.data(), 1.25F, 15.0F, width, values.data()};
    discountRow(row);
    row.values = plain_values.data();
    discountRowPlain(row);
    EXPECT_EQ(values, plain_values);
  }
}

Linearization curvatureOf(const cv::Size& size, float curvature, float noise)
{
  Linearization linearization;
  linearization.weight = cv::Mat(size, CV_32FC1, cv::Scalar(curvature));
  linearization.noise = cv::Mat(size, CV_32FC1, cv::Scalar(noise));
  return linearization;
}

TEST(NoiseDiscount, LeavesCleanViewsAsTheyAre)
{
  Linearization linearization = curvatureOf({70, 41}, 0.1F, 0.0F);
  linearization.weight.colRange(30, 70).setTo(900.0F);
  ThreadPool pool(2);
  NoiseDiscount().apply({}, pool, linearization);
  EXPECT_EQ(linearization.weight.at<float>(20, 10), 0.1F);
  EXPECT_EQ(linearization.weight.at<float>(20, 50), NoiseDiscountSettings().max_weight);
}

/// Single windows of a blank wall are above the noise by chance; all of it is not.
TEST(NoiseDiscount, NothingCountsWhereAllIsNoise)
{
  Linearization linearization = curvatureOf({120, 80}, 10.0F, 10.0F);
  for (int y = 0; y < 80; y += 9)
  {
    linearization.weight.row(y).setTo(18.0F);
  }
  linearization.weight.colRange(100, 120).setTo(100.0F);
  ThreadPool pool(1);
  NoiseDiscount().apply({}, pool, linearization);
  EXPECT_EQ(cv::countNonZero(linearization.weight.colRange(0, 84)), 0);
  EXPECT_EQ(linearization.weight.at<float>(40, 115), 100.0F - NoiseDiscountSettings().margin * 10.0F);
}

}  // namespace
}  // namespace light_field_depth::multiview
