// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/search/path_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <utility>

#include "core/multiview/search/path_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
#if HWY_TARGET == HWY_SCALAR
// A processor without any of the known vector instructions.
void stepRowSimd(const StepRow& row)
{
  stepRowPlain(row);
}

void walkTileSimd(const PathTile& tile, std::uint16_t* sums)
{
  walkTilePlain(tile, sums);
}

void walkBackTileSimd(const PathTile& tile, const std::uint16_t* sums, std::uint8_t* packed)
{
  walkBackTilePlain(tile, sums, packed);
}

void selectFromTileSimd(const PathTile& tile, const std::uint16_t* sums, const std::uint8_t* across,
                        int first_label, std::uint16_t* line, float* best)
{
  selectFromTilePlain(tile, sums, across, first_label, line, best);
}

void transposeBytesSimd(const std::uint8_t* source, int labels, std::uint8_t* target)
{
  transposeTilePlain(source, labels, target);
}

void transposeWordsSimd(const std::uint16_t* source, int labels, std::uint16_t* target)
{
  transposeTilePlain(source, labels, target);
}
#else
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint16_t, TILE_PX>;
using WordBytes = hn::Rebind<std::uint8_t, Words>;
using Vector = hn::Vec<Words>;
using SignedWords = hn::RebindToSigned<Words>;

void stepRowSimd(const StepRow& row)
{
  const Words words;
  const hn::Half<Words> half_words;
  const hn::Repartition<std::int32_t, Words> integers;
  const hn::Repartition<float, Words> floats;
  const auto steps = [&](hn::Vec<hn::Half<Words>> change) HWY_ATTR
  {
    const auto divisor =
        hn::Add(hn::Set(floats, 1.0F), hn::ConvertTo(floats, hn::PromoteTo(integers, change)));
    const auto step = hn::Max(hn::Set(floats, row.min_large_change_penalty),
                              hn::Div(hn::Set(floats, row.large_change_penalty), divisor));
    return hn::DemoteTo(half_words, hn::ConvertTo(integers, hn::Add(step, hn::Set(floats, 0.5F))));
  };
  for (int x = 0; x < row.width; x += static_cast<int>(hn::Lanes(words)))
  {
    const auto change = hn::LoadU(words, row.steps + x);
    hn::StoreU(hn::Combine(words, steps(hn::UpperHalf(half_words, change)),
                           steps(hn::LowerHalf(half_words, change))),
               words, row.steps + x);
  }
}

/// All labels of some paths in one line.
/// @param store takes the place of each vector of L in the line, and the vector
template <class Store>
HWY_INLINE void lineStep(const std::uint8_t* cost, int labels, Vector small_change_penalty,
                         const std::uint16_t* large_change_penalty, std::uint16_t* state,
                         std::uint16_t* minima, const Store& store)
{
  const Words words;
  const WordBytes bytes;
  const auto before_minimum = hn::LoadU(words, minima);
  const auto jump = hn::Add(before_minimum, hn::LoadU(words, large_change_penalty));
  auto least = hn::Set(words, NO_STATE);
  auto below = least;
  auto here = hn::LoadU(words, state);
  for (int label = 0; label < labels; ++label)
  {
    const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(label) * TILE_PX;
    const auto above = hn::LoadU(words, state + offset + TILE_PX);
    const auto neighbour = hn::SaturatedAdd(hn::Min(below, above), small_change_penalty);
    const auto best = hn::Min(hn::Min(here, jump), neighbour);
    const auto data = hn::PromoteTo(words, hn::LoadU(bytes, cost + offset));
    const auto value = hn::Add(data, hn::Sub(best, before_minimum));
    hn::StoreU(value, words, state + offset);
    least = hn::Min(least, value);
    store(offset, value);
    below = here;
    here = above;
  }
  hn::StoreU(least, words, minima);
}

/// @param store takes the place of a line in the tile, that of each vector of L in the line, and the vector
/// @param finish called with each line after it
template <class Store, class Finish>
HWY_INLINE void walkLines(const PathTile& tile, const Store& store, const Finish& finish)
{
  const Words words;
  const auto small_change_penalty = hn::Set(words, tile.small_change_penalty);
  const int lanes = static_cast<int>(hn::Lanes(words));
  const std::ptrdiff_t line_size = static_cast<std::ptrdiff_t>(tile.labels) * TILE_PX;
  for (int step = 0; step < tile.lines; ++step)
  {
    const int line = tile.backward ? tile.lines - 1 - step : step;
    for (int i = 0; i < TILE_PX; i += lanes)
    {
      lineStep(
          tile.cost + line * line_size + i, tile.labels, small_change_penalty,
          tile.large_change_penalty + line * tile.large_change_stride + i, tile.state + i, tile.minima + i,
          [&](std::ptrdiff_t offset, Vector value) HWY_ATTR { store(line * line_size, i + offset, value); });
    }
    finish(line);
  }
}

void walkTileSimd(const PathTile& tile, std::uint16_t* sums)
{
  const Words words;
  walkLines(
      tile,
      [&](std::ptrdiff_t first, std::ptrdiff_t at, Vector value) HWY_ATTR
      { hn::StoreU(value, words, sums + first + at); },
      [](int) {});
}

/// In units, rounded, and not yet limited to a byte.
HWY_INLINE hn::Vec<SignedWords> inUnits(Vector one, Vector opposite)
{
  const auto half = hn::Set(Words(), PACKED_UNIT / 2);
  return hn::BitCast(SignedWords(), hn::ShiftRight<PACKED_BITS>(hn::Add(hn::Add(one, half), opposite)));
}

void walkBackTileSimd(const PathTile& tile, const std::uint16_t* sums, std::uint8_t* packed)
{
  const Words words;
  const WordBytes bytes;
  walkLines(
      tile,
      [&](std::ptrdiff_t first, std::ptrdiff_t at, Vector value) HWY_ATTR
      {
        const auto units = inUnits(value, hn::LoadU(words, sums + first + at));
        hn::StoreU(hn::DemoteTo(bytes, units), bytes, packed + first + at);
      },
      [](int) {});
}

/// As many rows as a vector has parts of 128 bits, `step` apart, a part of each.
template <typename Tag, typename Value = hn::TFromD<Tag>>
HWY_INLINE hn::Vec<Tag> loadParts(Tag tag, const Value* source, std::ptrdiff_t step)
{
  constexpr std::size_t parts = hn::MaxLanes(Tag()) * sizeof(Value) / 16;
  if constexpr (parts <= 1)
  {
    return hn::LoadU(tag, source);
  }
  else
  {
    const hn::Half<Tag> half;
    return hn::Combine(tag, loadParts(half, source + static_cast<std::ptrdiff_t>(parts / 2) * step, step),
                       loadParts(half, source, step));
  }
}

/// Square blocks of 128 bits a row, one below the other, one for each such part of a vector: side by side in
/// the target. Rows are `stride` apart in the source and in the target. As many perfect shuffles as the side
/// has bits transpose a block.
template <typename Tag, std::size_t SIDE, typename Value = hn::TFromD<Tag>>
HWY_INLINE void transposeBlocks(const Value* source, std::ptrdiff_t stride, Value* target)
{
  const Tag tag;
  using Row = hn::Vec<Tag>;
  Row rows[SIDE];
  Row mixed[SIDE];
  for (std::size_t i = 0; i < SIDE; ++i)
  {
    rows[i] = loadParts(tag, source + static_cast<std::ptrdiff_t>(i) * stride,
                        static_cast<std::ptrdiff_t>(SIDE) * stride);
  }
  Row* from = rows;
  Row* to = mixed;
  for (std::size_t length = 1; length < SIDE; length *= 2)
  {
    for (std::size_t i = 0; i < SIDE / 2; ++i)
    {
      to[2 * i] = hn::InterleaveLower(tag, from[i], from[i + SIDE / 2]);
      to[2 * i + 1] = hn::InterleaveUpper(tag, from[i], from[i + SIDE / 2]);
    }
    std::swap(from, to);
  }
  for (std::size_t i = 0; i < SIDE; ++i)
  {
    hn::StoreU(from[i], tag, target + static_cast<std::ptrdiff_t>(i) * stride);
  }
}

template <typename Value>
HWY_INLINE void transposeLabels(const Value* source, int labels, Value* target)
{
  // Wider vectors would do as many shuffles at half the rate.
  using Tag = hn::CappedTag<Value, 32 / sizeof(Value)>;
  constexpr int side = static_cast<int>(16 / sizeof(Value));
  constexpr int lines = static_cast<int>(hn::MaxLanes(Tag()));
  const std::ptrdiff_t line_size = static_cast<std::ptrdiff_t>(labels) * TILE_PX;
  for (int label = 0; label < labels; ++label)
  {
    const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(label) * TILE_PX;
    for (int line = 0; line < TILE_PX; line += lines)
    {
      for (int i = 0; i < TILE_PX; i += side)
      {
        transposeBlocks<Tag, side>(source + line * line_size + offset + i, line_size,
                                   target + i * line_size + offset + line);
      }
    }
  }
}

void transposeBytesSimd(const std::uint8_t* source, int labels, std::uint8_t* target)
{
  transposeLabels(source, labels, target);
}

void transposeWordsSimd(const std::uint16_t* source, int labels, std::uint16_t* target)
{
  transposeLabels(source, labels, target);
}

/// The label of least sum in a line, with the position between labels from a V fitted to the neighbours.
HWY_INLINE void selectLabelsOf(const std::uint16_t* sums, int labels, int first_label, float* best)
{
  const Words words;
  HWY_ALIGN std::uint16_t label_of[TILE_PX];
  HWY_ALIGN std::uint16_t least_of[TILE_PX];
  HWY_ALIGN std::uint16_t below_of[TILE_PX];
  HWY_ALIGN std::uint16_t above_of[TILE_PX];
  const int lanes = static_cast<int>(hn::Lanes(words));
  for (int i = 0; i < TILE_PX; i += lanes)
  {
    auto least = hn::LoadU(words, sums + i);
    auto label_of_least = hn::Zero(words);
    auto below = least;
    auto above = least;
    auto before = least;
    auto was_better = hn::Eq(least, least);
    for (int label = 1; label < labels; ++label)
    {
      const auto sum = hn::LoadU(words, sums + static_cast<std::ptrdiff_t>(label) * TILE_PX + i);
      above = hn::IfThenElse(was_better, sum, above);
      const auto better = hn::Lt(sum, least);
      least = hn::Min(sum, least);
      label_of_least =
          hn::IfThenElse(better, hn::Set(words, static_cast<std::uint16_t>(label)), label_of_least);
      below = hn::IfThenElse(better, before, below);
      before = sum;
      was_better = better;
    }
    hn::Store(label_of_least, words, label_of + i);
    hn::Store(least, words, least_of + i);
    hn::Store(below, words, below_of + i);
    hn::Store(above, words, above_of + i);
  }
  for (int i = 0; i < TILE_PX; ++i)
  {
    const int label = label_of[i];
    const int below = below_of[i] - least_of[i];
    const int above = above_of[i] - least_of[i];
    const int steeper = std::max(below, above);
    const bool inside = label > 0 && label + 1 < labels && steeper > 0;
    const float shift =
        inside ? 0.5F * static_cast<float>(below - above) / static_cast<float>(steeper) : 0.0F;
    best[i] = static_cast<float>(first_label + label) + shift;
  }
}

void selectFromTileSimd(const PathTile& tile, const std::uint16_t* sums, const std::uint8_t* across,
                        int first_label, std::uint16_t* line, float* best)
{
  const Words words;
  const WordBytes bytes;
  const auto most = hn::Set(words, MAX_PACKED);
  walkLines(
      tile,
      [&](std::ptrdiff_t first, std::ptrdiff_t at, Vector value) HWY_ATTR
      {
        const auto units = hn::BitCast(words, inUnits(value, hn::LoadU(words, sums + first + at)));
        const auto others = hn::PromoteTo(words, hn::LoadU(bytes, across + first + at));
        hn::StoreU(hn::Add(hn::Min(units, most), others), words, line + at);
      },
      [&](int y) HWY_ATTR
      { selectLabelsOf(line, tile.labels, first_label, best + static_cast<std::ptrdiff_t>(y) * TILE_PX); });
}
#endif  // HWY_TARGET == HWY_SCALAR
}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(stepRowSimd);
HWY_EXPORT(walkTileSimd);
HWY_EXPORT(walkBackTileSimd);
HWY_EXPORT(selectFromTileSimd);
HWY_EXPORT(transposeBytesSimd);
HWY_EXPORT(transposeWordsSimd);

void stepRow(const StepRow& row)
{
  HWY_DYNAMIC_DISPATCH(stepRowSimd)(row);
}

void walkTile(const PathTile& tile, std::uint16_t* sums)
{
  HWY_DYNAMIC_DISPATCH(walkTileSimd)(tile, sums);
}

void walkBackTile(const PathTile& tile, const std::uint16_t* sums, std::uint8_t* packed)
{
  HWY_DYNAMIC_DISPATCH(walkBackTileSimd)(tile, sums, packed);
}

void selectFromTile(const PathTile& tile, const std::uint16_t* sums, const std::uint8_t* across,
                    int first_label, std::uint16_t* line, float* best)
{
  HWY_DYNAMIC_DISPATCH(selectFromTileSimd)(tile, sums, across, first_label, line, best);
}

void transposeTile(const std::uint8_t* source, int labels, std::uint8_t* target)
{
  HWY_DYNAMIC_DISPATCH(transposeBytesSimd)(source, labels, target);
}

void transposeTile(const std::uint16_t* source, int labels, std::uint16_t* target)
{
  HWY_DYNAMIC_DISPATCH(transposeWordsSimd)(source, labels, target);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
