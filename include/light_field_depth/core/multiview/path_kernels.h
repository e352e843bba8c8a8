#ifndef LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PATH_KERNELS_H
#define LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PATH_KERNELS_H

#include <cstddef>
#include <cstdint>

namespace light_field_depth::multiview
{
/// Recursion of semi-global matching along one path,
///   L(p, l) = C(p, l) + min(L(q, l), L(q, l - 1) + P1, L(q, l + 1) + P1, min L(q) + P2(p)) - min L(q),
/// on 16-bit integers, for pixels whose `pitch` labels lie together (pitch a multiple of 16). Each kernel has
/// a plain version that computes the same values.

/// Guard entries on either side of the labels of a state.
constexpr std::size_t STATE_GUARD = 16;
constexpr std::uint16_t STATE_GUARD_VALUE = 0xFFFF;

struct PathRow
{
  const std::uint8_t* cost = nullptr;  ///< [width][pitch]
  std::uint16_t* sums = nullptr;       ///< [width][pitch], where L is stored or added
  int width = 0;
  int pitch = 16;
  std::uint16_t p1 = 0;
  const std::uint16_t* p2 = nullptr;  ///< [width]
};

/// Both horizontal paths over one row. sums is overwritten. p2[x] belongs to the step between x - 1 and x.
/// @param states room for 4 * (pitch + 2 * STATE_GUARD), guards set by resetStates()
void aggregateRow(const PathRow& row, std::uint16_t* states);
void aggregateRowPlain(const PathRow& row, std::uint16_t* states);

/// One step of vertical paths, for all pixels of a row: reads the states of the previous row and writes those
/// of this one, [width][pitch + 2 * STATE_GUARD]; the minimum of each pixel in `minima`. L is added to sums.
/// With `first` the previous states are ignored: L = C.
void aggregateStep(const PathRow& row, bool first, const std::uint16_t* before, std::uint16_t* after,
                   std::uint16_t* minima);
void aggregateStepPlain(const PathRow& row, bool first, const std::uint16_t* before, std::uint16_t* after,
                        std::uint16_t* minima);

/// The label of least sum for each pixel, with the position between labels from a V fitted to the neighbours.
/// @param labels that count, <= pitch; the rest must have PADDING_COST  @param best [width]
void selectLabels(const std::uint16_t* sums, int width, int labels, int pitch, float* best);
void selectLabelsPlain(const std::uint16_t* sums, int width, int labels, int pitch, float* best);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PATH_KERNELS_H
