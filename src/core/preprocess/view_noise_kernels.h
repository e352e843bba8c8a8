#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_VIEW_NOISE_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_VIEW_NOISE_KERNELS_H

#include <cstddef>
#include <cstdint>

namespace light_field_depth
{
/// Side of the blocks in which two views are compared.
constexpr int NOISE_BLOCK_PX = 8;
/// Bytes of a row of such a block in colour.
constexpr int MAX_NOISE_BLOCK_BYTES = 3 * NOISE_BLOCK_PX;
/// Differences beyond this are no noise; sums over a block stay in 32 bits.
constexpr int MAX_NOISE_DIFFERENCE = 64;

/// A block of one view and one of another, NOISE_BLOCK_PX rows each.
struct BlockPair
{
  const std::uint8_t* one = nullptr;  ///< first byte of the block
  std::ptrdiff_t one_stride = 0;      ///< bytes from row to row
  const std::uint8_t* other = nullptr;
  std::ptrdiff_t other_stride = 0;
};

/// Sums over a block, or over one byte column of it.
struct DifferenceSums
{
  std::int32_t columns[MAX_NOISE_BLOCK_BYTES] = {};  ///< of the differences
  std::int32_t squares = 0;                          ///< of the differences
};

/// @param bytes of a row: 8 or 24
DifferenceSums sumDifferences(const BlockPair& pair, int bytes);
DifferenceSums sumDifferencesPlain(const BlockPair& pair, int bytes);

/// Sum of the squares of 12 times the slopes, along x and along y, of the difference of two blocks of one
/// channel, by differences of four pixels; two pixels beyond each side are read.
std::int32_t sumSlopes(const BlockPair& pair);
std::int32_t sumSlopesPlain(const BlockPair& pair);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_VIEW_NOISE_KERNELS_H
