#include <vector>

#include <gtest/gtest.h>

#include "core/multiview/refine/noise_discount_kernels.h"
#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
using testing::randomRow;

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

}  // namespace
}  // namespace light_field_depth::multiview
