#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/light_field/pixel_kernels.h"
#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
class PixelKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, PixelKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(PixelKernels, PixelsAreSplitAsInThePlainVersion)
{
  RandomRows random;
  const auto pixels = random.bytes(3 * ROW_WIDTH);
  std::vector<std::uint8_t> simd(3 * ROW_STRIDE, 9);
  auto plain = simd;
  splitPixels(
      {pixels.data(), ROW_WIDTH, {simd.data(), simd.data() + ROW_STRIDE, simd.data() + 2 * ROW_STRIDE}});
  splitPixelsPlain(
      {pixels.data(), ROW_WIDTH, {plain.data(), plain.data() + ROW_STRIDE, plain.data() + 2 * ROW_STRIDE}});
  EXPECT_EQ(simd, plain);
  EXPECT_EQ(plain[ROW_STRIDE + 100], pixels[301]);
  EXPECT_EQ(plain[ROW_STRIDE + ROW_WIDTH], 9);
}

}  // namespace
}  // namespace light_field_depth::multiview
