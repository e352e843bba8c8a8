#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/multiview/search/visibility_kernels.h"
#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
class VisibilityKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, VisibilityKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(VisibilityKernels, WarpTargetsEqualThePlainVersion)
{
  RandomRows random;
  const auto disparity = random.floats(ROW_WIDTH, -3.0F, 3.0F);
  for (const float step_y : {0.0F, -2.5F})
  {
    const WarpRow row{disparity.data(), ROW_WIDTH, 24, 3.0F, step_y, 0.8F, 2.5F, 256, 8};
    std::vector<std::int32_t> simd(ROW_WIDTH);
    std::vector<std::int32_t> plain(ROW_WIDTH);
    warpTargets(row, simd.data());
    warpTargetsPlain(row, plain.data());
    EXPECT_EQ(simd, plain);
    EXPECT_NE(std::count(plain.begin(), plain.end(), 0), 0);
    const auto column = static_cast<int>(std::floor(100.8F - 3.0F * disparity[100]));
    const auto line = static_cast<int>(std::floor(2.5F - step_y * disparity[100]));
    EXPECT_EQ(plain[100], line >= 0 && line < 24 ? line * 256 + column + 8 : 0);
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
