#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_SWEEP_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_SWEEP_KERNELS_H

#include <cstddef>
#include <cstdint>

namespace light_field_depth
{
/// The inner loops of plane sweeps and of exposure, each over `count` elements, with the best vector
/// instructions that the processor has. Results do not depend on these.

/// Fractions of a pixel are given in so many parts.
constexpr int SWEEP_FRACTIONS = 32;
/// Bytes beyond the end of a row that the next two may read, and write again with their values.
constexpr int SWEEP_ROW_PADDING = 64;
/// Costs are means over windows of so many pixels on both sides of a pixel.
constexpr int SWEEP_WINDOW_RADIUS = 2;

/// The rows of a block of bytes.
template <class Byte>
struct ByteRows
{
  Byte* first;
  std::ptrdiff_t stride;

  Byte* row(int y) const { return first + y * stride; }
};

/// A part of the reference and what a view shows of it: a pixel of it is seen between one of the view, its
/// right neighbour and those below them, so many SWEEP_FRACTIONS away from the former. With a fraction of 0
/// there need be no neighbour. All rows have padding.
struct SweptBlock
{
  ByteRows<const std::uint8_t> reference;
  ByteRows<const std::uint8_t> view;
  int fraction_x;
  int fraction_y;
  int width;
  int height;
};

/// sums -= most - min(|reference - view|, most), modulo 256. Values between rows are rounded, and then those
/// between columns.
/// @param sums as many rows, with padding
void subtractLikeness(const SweptBlock& block, std::uint8_t most, const ByteRows<std::uint8_t>& sums);

/// The sums over the views of an arm.
struct ArmSums
{
  /// Of width + 2 * SWEEP_WINDOW_RADIUS columns, with padding; rows outside repeat the outermost.
  ByteRows<const std::uint8_t> sums;
  std::uint16_t factor;
};

/// The mean over the arms, but for the worst of several, of window * factor / 65536, where window sums up the
/// (2 * SWEEP_WINDOW_RADIUS + 1)^2 bytes about a pixel and stays below 65536. All are rounded down.
/// @param count_of_arms 1 to 4; the total over the arms is below 32768
/// @param columns memory of count_of_arms * columnsOfWindows(width) words
/// @param cost width * height
void meanOfWindows(const ArmSums* arms, std::size_t count_of_arms, int width, int height,
                   std::uint16_t* columns, std::uint16_t* cost);
std::size_t columnsOfWindows(int width);

/// Where cost < best_cost: best_cost = cost, best_label = label.
void keepBest(const std::uint16_t* cost, std::uint16_t label, std::size_t count, std::uint16_t* best_cost,
              std::uint16_t* best_label);

/// least = min(least, cost) where |label - best_label| >= distance.
void keepRival(const std::uint16_t* cost, std::uint16_t label, const std::uint16_t* best_label,
               std::uint16_t distance, std::size_t count, std::uint16_t* least);

/// to = value * (factor + shading * gain) + offset, rounded and kept in 0..255.
struct ExposureRow
{
  const float* factor;
  const float* gain;
  const float* offset;
  float shading;
};
void exposeBytes(const std::uint8_t* value, const ExposureRow& row, std::size_t count, std::uint8_t* to);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_SWEEP_KERNELS_H
