#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/light_field/half_resolution_kernels.h"
#include "support/instruction_sets.h"

namespace light_field_depth::multiview
{
namespace
{
std::vector<std::uint8_t> randomBytes(std::size_t count)
{
  std::mt19937 engine(5);
  std::uniform_int_distribution<int> any(0, 255);
  std::vector<std::uint8_t> bytes(count);
  for (auto& byte : bytes)
  {
    byte = static_cast<std::uint8_t>(any(engine));
  }
  return bytes;
}

class HalfResolutionKernels : public testing::InstructionSetTest
{
};

TEST_P(HalfResolutionKernels, EqualThePlainVersion)
{
  for (const int channels : {1, 3})
  {
    for (const int width : {1, 7, 64, 203})
    {
      const auto count = 2 * static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
      const auto pixels = randomBytes(2 * count);
      std::vector<std::uint8_t> fast(static_cast<std::size_t>(width));
      std::vector<std::uint8_t> plain(fast.size());
      halveRow(pixels.data(), pixels.data() + count, channels, width, fast.data());
      halveRowPlain(pixels.data(), pixels.data() + count, channels, width, plain.data());
      EXPECT_EQ(fast, plain) << channels << " channels, width " << width;
    }
  }
}

TEST_P(HalfResolutionKernels, OfAllChannelsEqualThePlainVersion)
{
  for (const int channels : {1, 3})
  {
    for (const int width : {1, 7, 64, 203})
    {
      const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
      const auto pixels = randomBytes(4 * count);
      std::vector<std::uint8_t> fast(count);
      std::vector<std::uint8_t> plain(count);
      halveChannelsRow(pixels.data(), pixels.data() + 2 * count, channels, width, fast.data());
      halveChannelsRowPlain(pixels.data(), pixels.data() + 2 * count, channels, width, plain.data());
      EXPECT_EQ(fast, plain) << channels << " channels, width " << width;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, HalfResolutionKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

}  // namespace
}  // namespace light_field_depth::multiview
