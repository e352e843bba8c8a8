#include <algorithm>
#include <cmath>

#include "core/multiview/search/path_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// One path, whose values lie TILE_PX apart, in one line.
void pathStep(const std::uint8_t* cost, int labels, int small_change_penalty, int large_change_penalty,
              std::uint16_t* state, std::uint16_t& minimum)
{
  const int before_minimum = minimum;
  int below = NO_STATE;
  int least = NO_STATE;
  for (int label = 0; label < labels; ++label)
  {
    std::uint16_t& here = state[static_cast<std::ptrdiff_t>(label) * TILE_PX];
    const int above = state[static_cast<std::ptrdiff_t>(label + 1) * TILE_PX];
    const int neighbour = std::min(below, above) + small_change_penalty;
    const int best = std::min({static_cast<int>(here), neighbour, before_minimum + large_change_penalty});
    below = here;
    here = static_cast<std::uint16_t>(cost[static_cast<std::ptrdiff_t>(label) * TILE_PX] + best -
                                      before_minimum);
    least = std::min<int>(least, here);
  }
  minimum = static_cast<std::uint16_t>(least);
}

int inUnits(int sum)
{
  return std::min((sum + PACKED_UNIT / 2) / PACKED_UNIT, MAX_PACKED);
}

/// @param store takes the place of a line in the tile, that of each L in the line, and L
/// @param finish called with each line after it
template <typename Store, typename Finish>
void walkLines(const PathTile& tile, const Store& store, const Finish& finish)
{
  const std::ptrdiff_t line_size = static_cast<std::ptrdiff_t>(tile.labels) * TILE_PX;
  for (int step = 0; step < tile.lines; ++step)
  {
    const int line = tile.backward ? tile.lines - 1 - step : step;
    for (int i = 0; i < TILE_PX; ++i)
    {
      pathStep(tile.cost + line * line_size + i, tile.labels, tile.small_change_penalty,
               tile.large_change_penalty[line * tile.large_change_stride + i], tile.state + i,
               tile.minima[i]);
    }
    for (std::ptrdiff_t k = 0; k < line_size; ++k)
    {
      store(line * line_size, k, tile.state[k]);
    }
    finish(line);
  }
}

template <typename Value>
void transposePlain(const Value* source, int labels, Value* target)
{
  const std::ptrdiff_t line_size = static_cast<std::ptrdiff_t>(labels) * TILE_PX;
  for (int line = 0; line < TILE_PX; ++line)
  {
    for (int label = 0; label < labels; ++label)
    {
      for (int i = 0; i < TILE_PX; ++i)
      {
        target[i * line_size + label * TILE_PX + line] = source[line * line_size + label * TILE_PX + i];
      }
    }
  }
}

/// The label of least sum in a line, with the position between labels from a V fitted to the neighbours; the
/// lowest of several.
void selectLabels(const std::uint16_t* sums, int labels, int first_label, float* best)
{
  for (int i = 0; i < TILE_PX; ++i)
  {
    const auto sum = [&](int label) { return sums[static_cast<std::ptrdiff_t>(label) * TILE_PX + i]; };
    int label = 0;
    for (int other = 1; other < labels; ++other)
    {
      label = sum(other) < sum(label) ? other : label;
    }
    float shift = 0.0F;
    if (label > 0 && label + 1 < labels)
    {
      const int below = sum(label - 1) - sum(label);
      const int above = sum(label + 1) - sum(label);
      const int steeper = std::max(below, above);
      shift = steeper > 0 ? 0.5F * static_cast<float>(below - above) / static_cast<float>(steeper) : 0.0F;
    }
    best[i] = static_cast<float>(first_label + label) + shift;
  }
}

}  // namespace

void stepRowPlain(const StepRow& row)
{
  for (int x = 0; x < row.width; ++x)
  {
    const float step = row.large_change_penalty / (1.0F + static_cast<float>(row.steps[x]));
    row.steps[x] = static_cast<std::uint16_t>(std::lround(std::max(row.min_large_change_penalty, step)));
  }
}

void walkTilePlain(const PathTile& tile, std::uint16_t* sums)
{
  walkLines(
      tile, [&](std::ptrdiff_t first, std::ptrdiff_t at, std::uint16_t value) { sums[first + at] = value; },
      [](int) {});
}

void walkBackTilePlain(const PathTile& tile, const std::uint16_t* sums, std::uint8_t* packed)
{
  const auto store = [&](std::ptrdiff_t first, std::ptrdiff_t at, int value)
  { packed[first + at] = static_cast<std::uint8_t>(inUnits(sums[first + at] + value)); };
  walkLines(tile, store, [](int) {});
}

void selectFromTilePlain(const PathTile& tile, const std::uint16_t* sums, const std::uint8_t* across,
                         int first_label, std::uint16_t* line, float* best)
{
  const auto store = [&](std::ptrdiff_t first, std::ptrdiff_t at, int value)
  { line[at] = static_cast<std::uint16_t>(inUnits(sums[first + at] + value) + across[first + at]); };
  walkLines(tile, store,
            [&](int y) {
              selectLabels(line, tile.labels, first_label, best + static_cast<std::ptrdiff_t>(y) * TILE_PX);
            });
}

void transposeTilePlain(const std::uint8_t* source, int labels, std::uint8_t* target)
{
  transposePlain(source, labels, target);
}

void transposeTilePlain(const std::uint16_t* source, int labels, std::uint16_t* target)
{
  transposePlain(source, labels, target);
}

}  // namespace light_field_depth::multiview
