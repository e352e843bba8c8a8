#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/multiview/search/path_kernels.h"
#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
using testing::randomValues;

constexpr std::size_t TILE_AREA = static_cast<std::size_t>(TILE_PX) * TILE_PX;

struct TileBuffers
{
  explicit TileBuffers(int labels, unsigned seed)
      : state(static_cast<std::size_t>(labels + 2) * TILE_PX, NO_STATE),
        minima(randomValues<std::uint16_t>(TILE_PX, 0, 100, seed)),
        sums(randomValues<std::uint16_t>(static_cast<std::size_t>(labels) * TILE_AREA, 0, 900, seed + 1))
  {
    const auto before =
        randomValues<std::uint16_t>(static_cast<std::size_t>(labels) * TILE_PX, 100, 1400, seed + 2);
    std::copy(before.begin(), before.end(), state.begin() + TILE_PX);
  }
  std::vector<std::uint16_t> state;
  std::vector<std::uint16_t> minima;
  std::vector<std::uint16_t> sums;
};

class PathKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, PathKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(PathKernels, StepsEqualThePlainVersion)
{
  constexpr int width = 203;  // no multiple of any vector
  constexpr std::size_t stride = 256;
  const auto changes = randomValues<std::uint16_t>(stride, 0, 40, 8);
  auto simd = changes;
  auto plain = changes;
  stepRow({1200.0F, 67.5F, width, simd.data()});
  stepRowPlain({1200.0F, 67.5F, width, plain.data()});
  simd.resize(width);
  plain.resize(width);
  EXPECT_EQ(simd, plain);
  EXPECT_GT(*std::max_element(plain.begin(), plain.end()), 500);
  EXPECT_EQ(*std::min_element(plain.begin(), plain.end()), 68);
}

TEST_P(PathKernels, TilesEqualThePlainVersion)
{
  for (const int labels : {1, 2, 29})
  {
    const auto cost = randomValues<std::uint8_t>(static_cast<std::size_t>(labels) * TILE_AREA, 0, 240, 1);
    const auto large_change_penalty = randomValues<std::uint16_t>(TILE_AREA, 45, 1000, 2);
    for (const bool backward : {false, true})
    {
      for (const int lines : {TILE_PX, 13})
      {
        TileBuffers simd(labels, 3);
        TileBuffers plain(labels, 3);
        const auto tile = [&](TileBuffers& buffers)
        {
          return PathTile{cost.data(),
                          buffers.sums.data(),
                          backward,
                          labels,
                          lines,
                          backward,
                          30,
                          large_change_penalty.data(),
                          TILE_PX,
                          buffers.state.data() + TILE_PX,
                          buffers.minima.data()};
        };
        aggregateTile(tile(simd));
        aggregateTilePlain(tile(plain));
        EXPECT_EQ(simd.sums, plain.sums) << labels << " labels, " << lines << " lines";
        EXPECT_EQ(simd.state, plain.state);
        EXPECT_EQ(simd.minima, plain.minima);
      }
    }
  }
}

TEST_P(PathKernels, TransposedTilesEqualThePlainVersion)
{
  constexpr int labels = 5;
  const auto bytes = randomValues<std::uint8_t>(labels * TILE_AREA, 0, 255, 4);
  std::vector<std::uint8_t> simd_bytes(bytes.size());
  std::vector<std::uint8_t> plain_bytes(bytes.size());
  transposeTile(bytes.data(), labels, simd_bytes.data());
  transposeTilePlain(bytes.data(), labels, plain_bytes.data());
  EXPECT_EQ(simd_bytes, plain_bytes);
  const auto words = randomValues<std::uint16_t>(labels * TILE_AREA, 0, 65535, 5);
  std::vector<std::uint16_t> simd_words(words.size());
  std::vector<std::uint16_t> plain_words(words.size());
  transposeTile(words.data(), labels, simd_words.data());
  transposeTilePlain(words.data(), labels, plain_words.data());
  EXPECT_EQ(simd_words, plain_words);
  transposeTile(simd_words.data(), labels, plain_words.data());
  EXPECT_EQ(plain_words, words);
}

TEST_P(PathKernels, LabelsEqualThePlainVersion)
{
  for (const int labels : {1, 2, 29})
  {
    for (const int highest : {3, 65000})  // the first with many equal sums
    {
      const auto sums =
          randomValues<std::uint16_t>(static_cast<std::size_t>(labels) * TILE_PX, 0, highest, 6);
      std::array<float, TILE_PX> simd{};
      std::array<float, TILE_PX> plain{};
      selectLabels(sums.data(), labels, 7, simd.data());
      selectLabelsPlain(sums.data(), labels, 7, plain.data());
      EXPECT_EQ(simd, plain) << labels << " labels";
    }
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
