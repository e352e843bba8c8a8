#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_COST_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_COST_KERNELS_H

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/light_field/view_set.h"

namespace light_field_depth::multiview
{
/// Row kernels of the cost volume. Each has a plain version that computes the same values bit for bit. All
/// of them may read and write up to VECTOR_OVERRUN bytes past the last pixel of a row.
constexpr std::size_t VECTOR_OVERRUN = 64;

/// A cost of this value means that every view that counts differs by the truncation or more.
constexpr int FULL_COST = 240;

/// Catmull-Rom interpolation between taps[1] and taps[2] at `phase` / SUBPIXEL_PHASES, in 6-bit fixed point.
void interpolateTaps(const std::array<const std::uint8_t*, 4>& taps, int phase, int count,
                     std::uint8_t* values);
void interpolateTapsPlain(const std::array<const std::uint8_t*, 4>& taps, int phase, int count,
                          std::uint8_t* values);

/// What one row of the first cost volume is made of.
struct ArmCostRow
{
  const std::uint8_t* reference = nullptr;  ///< pixel 0, channels `reference_stride` apart
  std::size_t reference_stride = 0;
  const std::uint8_t* const* samples = nullptr;  ///< one pointer a view, ordered by arms
  std::size_t sample_stride = 0;                 ///< bytes between the channels of a sample row
  int channels = 3;
  int width = 0;
  int truncation = 30;  ///< of the sum of absolute differences over the channels of one view
  const Arm* arms = nullptr;
  int arm_count = 0;
  int best_arms = 1;                          ///< 1, 2 or 4: the cost is the mean of that many best arms
  const std::uint16_t* arm_scales = nullptr;  ///< an arm's sum of costs * scale / 2^8 has the full scale 240
};

/// The cost of one label in one row: in each arm the sum of truncated absolute differences, then the mean of
/// the best arms. 0..FULL_COST.
void armCostRow(const ArmCostRow& row, std::uint8_t* cost);
void armCostRowPlain(const ArmCostRow& row, std::uint8_t* cost);

/// Which pixels of a row are masked, not 0 there; nullptr where none is.
struct RowMasks
{
  const std::uint8_t* reference = nullptr;
  const std::uint8_t* const* views = nullptr;  ///< one pointer a view, moved as its samples are
  int view_count = 0;
};

/// Costs of armCostRow() anew where a view is masked, from the others; FULL_COST where all are. Where the
/// reference is masked, the other views are compared with each other: what goes on behind the mask tells a
/// blank surface at its border how far it is. There are few such pixels, so that a plain version is enough.
void maskArmCosts(const ArmCostRow& row, const RowMasks& masks, std::uint8_t* cost);

/// What one row of the cost volume with known visibility is made of.
struct VisibleCostRow
{
  const std::uint8_t* reference = nullptr;
  std::size_t reference_stride = 0;
  const std::uint8_t* const* samples = nullptr;
  std::size_t sample_stride = 0;
  /// For each view, the labels (plus VISIBILITY_BIAS) of the surface that it sees there; 0 unknown, 255 out
  /// of the frame.
  const std::uint8_t* const* surfaces = nullptr;
  int views = 0;
  int channels = 3;
  int width = 0;
  int truncation = 30;
  int hidden_above = 0;  ///< a view whose surface lies above this value does not count
  int min_seeing_views = 3;
  int unseen_penalty = 0;  ///< cost of each view that is missing to min_seeing_views
};

/// The cost of one label in one row over the views that see it. 0..FULL_COST.
void visibleCostRow(const VisibleCostRow& row, std::uint8_t* cost);
void visibleCostRowPlain(const VisibleCostRow& row, std::uint8_t* cost);

/// Costs of visibleCostRow() anew where the reference is masked, as maskArmCosts() has them.
/// @pre masks.reference is not nullptr
void maskVisibleCosts(const VisibleCostRow& row, const RowMasks& masks, std::uint8_t* cost);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_COST_KERNELS_H
