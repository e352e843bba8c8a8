#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_BACKGROUND_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_BACKGROUND_KERNELS_H

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/multiview/search/label_bands.h"

namespace light_field_depth::multiview
{
/// Loops of the background fusion (background_fusion.h) over one row of one tile of a cost volume. Every
/// kernel has a plain version that computes the same values bit for bit.

/// Where no label is.
constexpr std::int16_t NO_LABEL = -1;

/// The costs of one row of a tile.
struct TileLine
{
  const std::uint8_t* costs = nullptr;  ///< [band.count][TILE_PX]
  LabelBand band;                       ///< empty where there is no such tile

  const std::uint8_t* at(int label) const
  {
    return costs + static_cast<std::ptrdiff_t>(label - band.first) * TILE_PX;
  }
  /// Whether the labels `distance` below and above are in the band.
  bool comparable(int label, int distance) const
  {
    return band.contains(label - distance) && band.contains(label + distance);
  }
};

/// The costs at a map's labels, in between by a line, and these labels, rounded.
struct LabelCosts
{
  TileLine line;
  const float* label = nullptr;     ///< [count]
  int count = TILE_PX;              ///< pixels
  float* cost = nullptr;            ///< [count], result; of the next label of the band outside of it
  std::int16_t* rounded = nullptr;  ///< [count], result
};

void findLabelCosts(const LabelCosts& costs);
void findLabelCostsPlain(const LabelCosts& costs);

/// How much worse the labels `distance` below and above a pixel's label are, summed over 3 x 3 pixels.
struct SupportLine
{
  /// Of the rows above, at and below the pixels.
  using Lines = std::array<TileLine, 3>;
  Lines here;
  Lines left;  ///< in the tile on the left
  Lines right;
  int distance = 1;
  int threshold = 0;  ///< the sum must exceed it, -NO_SUPPORT .. NO_SUPPORT
};
/// More than any sum over 3 x 3 pixels with two differences of bytes each.
constexpr int NO_SUPPORT = 9 * 2 * 255 + 1;

/// Adds to counts[label] the pixels whose label all of their 3 x 3 neighbours have with those `distance`
/// away, and whose sum exceeds the threshold.
/// @param labels [TILE_PX], NO_LABEL where a pixel does not count; overwritten
void countSupported(const SupportLine& line, std::int16_t* labels, int* counts);
void countSupportedPlain(const SupportLine& line, const std::int16_t* labels, int* counts);

/// costs[label][i] += charge[label], up to 255.
/// @param costs [labels][TILE_PX]
void addCharges(const std::uint8_t* charge, int labels, std::uint8_t* costs);
void addChargesPlain(const std::uint8_t* charge, int labels, std::uint8_t* costs);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_BACKGROUND_KERNELS_H
