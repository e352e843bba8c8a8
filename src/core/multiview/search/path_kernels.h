#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_PATH_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_PATH_KERNELS_H

#include <cstddef>
#include <cstdint>

#include "core/multiview/search/label_bands.h"

namespace light_field_depth::multiview
{
/// Recursion of semi-global matching along one path,
///   L(p, l) = C(p, l) + min(L(q, l), L(q, l - 1) + P1, L(q, l + 1) + P1, min L(q) + P2(p)) - min L(q),
/// on 16-bit integers, for TILE_PX paths side by side. A tile consists of TILE_PX lines across its paths; a
/// line has TILE_PX values for each label. Every kernel has a plain version that computes the same values.

/// A state that is never chosen.
constexpr std::uint16_t NO_STATE = 0xFFFF;

/// P2 of the steps along a row of a guide.
struct StepRow
{
  float large_change_penalty = 0.0F;
  float min_large_change_penalty = 0.0F;
  int width = 0;  ///< up to TILE_PX - 1 more are read and written
  /// The changes of colour (pixel_kernels.h) on entry, P2 on return.
  std::uint16_t* steps = nullptr;
};

/// max(min_large_change_penalty, large_change_penalty / (1 + change)), to the nearest.
void stepRow(const StepRow& row);
void stepRowPlain(const StepRow& row);

struct PathTile
{
  const std::uint8_t* cost = nullptr;  ///< [line][label][TILE_PX]
  int labels = 0;
  int lines = TILE_PX;
  bool backward = false;  ///< begin with the last of the lines
  std::uint16_t small_change_penalty = 0;
  /// P2 of the step to each line from the one before it on the path: TILE_PX values a line.
  const std::uint16_t* large_change_penalty = nullptr;
  std::ptrdiff_t large_change_stride = 0;
  /// L of the line before, and after the call L of the last line: [label][TILE_PX], with one more label on
  /// either side that is NO_STATE. All 0 where the path begins.
  std::uint16_t* state = nullptr;
  std::uint16_t* minima = nullptr;  ///< [TILE_PX], the least of the state
};

/// Sums of two opposite paths are counted in units of PACKED_UNIT, to the nearest, at most MAX_PACKED of
/// them, so that bytes hold them. Labels that one pair of paths finds so much worse than others are seldom
/// chosen, and finer sums do not make the map better (docs/experiments.md).
constexpr int PACKED_BITS = 2;
constexpr int PACKED_UNIT = 1 << PACKED_BITS;
constexpr int MAX_PACKED = 255;

/// Stores L. @param sums of the shape of the costs, as all below
void walkTile(const PathTile& tile, std::uint16_t* sums);
void walkTilePlain(const PathTile& tile, std::uint16_t* sums);

/// Packs the sum of L and of what walkTile() stored of the opposite path.
void walkBackTile(const PathTile& tile, const std::uint16_t* sums, std::uint8_t* packed);
void walkBackTilePlain(const PathTile& tile, const std::uint16_t* sums, std::uint8_t* packed);

/// Likewise, but for the last pair of paths: the label of the least sum of both pairs, with the position
/// between labels from a V fitted to the neighbours; the lowest of several.
/// @param across what walkBackTile() packed of the other pair  @param first_label of the band
/// @param line [labels][TILE_PX], overwritten  @param best [line][TILE_PX]
void selectFromTile(const PathTile& tile, const std::uint16_t* sums, const std::uint8_t* across,
                    int first_label, std::uint16_t* line, float* best);
void selectFromTilePlain(const PathTile& tile, const std::uint16_t* sums, const std::uint8_t* across,
                         int first_label, std::uint16_t* line, float* best);

/// [line][label][i] -> [i][label][line]: the same tile for the paths across.
void transposeTile(const std::uint8_t* source, int labels, std::uint8_t* target);
void transposeTile(const std::uint16_t* source, int labels, std::uint16_t* target);
void transposeTilePlain(const std::uint8_t* source, int labels, std::uint8_t* target);
void transposeTilePlain(const std::uint16_t* source, int labels, std::uint16_t* target);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_PATH_KERNELS_H
