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

/// A seed with many equal sums among which to choose.
constexpr unsigned ALIKE = 0;

/// The walks through a tile of one kind.
struct Walks
{
  std::vector<std::uint16_t> stored;
  std::vector<std::uint8_t> packed;
  std::vector<float> best;
  std::vector<std::uint16_t> state;  // after the last one
  std::vector<std::uint16_t> minima;

  friend bool operator==(const Walks& left, const Walks& right)
  {
    return left.stored == right.stored && left.packed == right.packed && left.best == right.best &&
           left.state == right.state && left.minima == right.minima;
  }
};

template <class Walk, class Back, class Select>
Walks walksOf(PathTile tile, unsigned seed, Walk walk, Back back, Select select)
{
  const auto size = static_cast<std::size_t>(tile.labels) * TILE_AREA;
  Walks walks{std::vector<std::uint16_t>(size),
              std::vector<std::uint8_t>(size),
              std::vector<float>(TILE_AREA),
              {},
              {}};
  std::vector<std::uint16_t> line(static_cast<std::size_t>(tile.labels) * TILE_PX);
  const auto fresh = [&](TileBuffers& buffers)
  {
    tile.state = buffers.state.data() + TILE_PX;
    tile.minima = buffers.minima.data();
    return tile;
  };
  TileBuffers first(tile.labels, seed);
  walk(fresh(first), walks.stored.data());
  TileBuffers second(tile.labels, seed + 3);
  back(fresh(second), first.sums.data(), walks.packed.data());
  TileBuffers third(tile.labels, seed + 6);
  if (seed == ALIKE)
  {
    std::fill(third.state.begin() + TILE_PX, third.state.end() - TILE_PX, std::uint16_t{0});
    std::fill(third.minima.begin(), third.minima.end(), std::uint16_t{0});
    third.sums = randomValues<std::uint16_t>(size, 0, 12, seed);
  }
  const auto across = seed == ALIKE ? std::vector<std::uint8_t>(size) : walks.packed;
  select(fresh(third), third.sums.data(), across.data(), 7, line.data(), walks.best.data());
  walks.state = third.state;
  walks.minima = third.minima;
  return walks;
}

TEST_P(PathKernels, TilesEqualThePlainVersion)
{
  for (const int labels : {1, 2, 29})
  {
    for (const unsigned seed : {ALIKE, 3U})
    {
      const auto cost = randomValues<std::uint8_t>(static_cast<std::size_t>(labels) * TILE_AREA, 0,
                                                   seed == ALIKE ? 0 : 240, 1);
      const auto large_change_penalty = randomValues<std::uint16_t>(TILE_AREA, 45, 1000, 2);
      for (const bool backward : {false, true})
      {
        for (const int lines : {TILE_PX, 13})
        {
          PathTile tile;
          tile.cost = cost.data();
          tile.labels = labels;
          tile.lines = lines;
          tile.backward = backward;
          tile.small_change_penalty = 30;
          tile.large_change_penalty = large_change_penalty.data();
          tile.large_change_stride = TILE_PX;
          const Walks simd = walksOf(tile, seed, walkTile, walkBackTile, selectFromTile);
          const Walks plain = walksOf(tile, seed, walkTilePlain, walkBackTilePlain, selectFromTilePlain);
          EXPECT_TRUE(simd == plain) << labels << " labels, " << lines << " lines";
        }
      }
    }
  }
}

TEST_P(PathKernels, SumsArePackedInUnitsToTheNearestUpToTheMost)
{
  std::array<std::uint8_t, TILE_AREA> cost{};
  cost.fill(1);
  std::array<std::uint16_t, TILE_PX> penalty{};
  std::array<std::uint16_t, 3 * TILE_PX> state{};
  std::array<std::uint16_t, TILE_PX> minima{};
  std::vector<std::uint16_t> sums(TILE_AREA);
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    sums[i] = static_cast<std::uint16_t>(2 * i);
  }
  PathTile tile;
  tile.cost = cost.data();
  tile.labels = 1;
  tile.large_change_penalty = penalty.data();
  tile.state = state.data() + TILE_PX;
  tile.minima = minima.data();
  std::array<std::uint8_t, TILE_AREA> packed{};
  walkBackTile(tile, sums.data(), packed.data());
  for (std::size_t i = 0; i < packed.size(); ++i)
  {
    const auto value = static_cast<int>(2 * i) + 1;  // one label: L is its cost
    ASSERT_EQ(packed[i], std::min((value + PACKED_UNIT / 2) / PACKED_UNIT, MAX_PACKED)) << i;
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

}  // namespace
}  // namespace light_field_depth::multiview
