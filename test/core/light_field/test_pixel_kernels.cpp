#include <algorithm>
#include <cstdint>
#include <random>
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

TEST_P(PixelKernels, ChangesOfColourEqualThePlainVersion)
{
  constexpr int width = 203;  // no multiple of any vector
  std::mt19937 engine(3);
  std::vector<std::uint8_t> pixels(6 * 256);
  std::generate(pixels.begin(), pixels.end(), [&] { return static_cast<std::uint8_t>(engine()); });
  for (const int channels : {1, 3})
  {
    const ColourChangeRow row{pixels.data() + 1, pixels.data() + 3 * 256, 256, channels, width};
    std::vector<std::uint16_t> left(width);
    std::vector<std::uint16_t> above(width);
    std::vector<std::uint16_t> left_plain(width);
    std::vector<std::uint16_t> above_plain(width);
    colourChanges(row, left.data(), above.data());
    colourChangesPlain(row, left_plain.data(), above_plain.data());
    EXPECT_EQ(left, left_plain);
    EXPECT_EQ(above, above_plain);
    EXPECT_EQ(left[0] == left[1] && left[1] == left[2], false);
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
