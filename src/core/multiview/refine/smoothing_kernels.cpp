// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/refine/smoothing_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/base/pixel_loops-inl.h"
#include "core/multiview/refine/smoothing_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;
void linkRowSimd(const LinkRow& row)
{
  const auto robust = [&](auto f, auto guide, auto change)
  {
    const auto flat = hn::Set(f, row.flat_px);
    const auto root = hn::Sqrt(hn::Add(hn::Mul(change, change), hn::Mul(flat, flat)));
    return hn::Mul(guide, hn::Div(flat, root));
  };
  row.left[0] = 0.0F;
  row.left[row.width] = 0.0F;
  forPixels(1, row.width,
            [&](auto f, int x)
            {
              const auto change =
                  hn::Sub(hn::Sub(hn::LoadU(f, row.disparity + x), hn::LoadU(f, row.disparity + x - 1)),
                          hn::LoadU(f, row.slope_left + x));
              hn::StoreU(robust(f, hn::LoadU(f, row.guide_left + x), change), f, row.left + x);
            });
  forPixels(0, row.width,
            [&](auto f, int x)
            {
              const auto change =
                  hn::Sub(hn::Sub(hn::LoadU(f, row.disparity + x), hn::LoadU(f, row.above + x)),
                          hn::LoadU(f, row.slope_above + x));
              hn::StoreU(robust(f, hn::LoadU(f, row.guide_above + x), change), f, row.up + x);
            });
}

/// Columns of a tile that lies in the nearest cache.
constexpr int TILE_COLUMNS = 32;
constexpr std::size_t LANES = hn::MaxLanes(Floats());
constexpr std::size_t SIDE = 4;  // of the squares that are transposed
constexpr std::size_t ROWS = ROWS_AT_ONCE;

/// Numbers of some rows at the columns of a tile, and of the columns to the right that fill a square.
struct RowTile
{
  static constexpr std::size_t COLUMNS = TILE_COLUMNS + SIDE;
  HWY_ALIGN float at[ROWS][COLUMNS];
};

struct ColumnTile
{
  HWY_ALIGN float at[RowTile::COLUMNS][ROWS];
};

struct SystemTile
{
  RowTile left;
  RowTile diagonal;
  RowTile side;
  ColumnTile left_columns;
  ColumnTile diagonal_columns;
  ColumnTile side_columns;
};

/// 4 x 4 numbers.
HWY_INLINE void transposeSquare(const float* from, std::size_t from_stride, float* to, std::size_t to_stride)
{
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t i = 0; i < SIDE; ++i)
  {
    for (std::size_t j = 0; j < SIDE; ++j)
    {
      to[j * to_stride + i] = from[i * from_stride + j];
    }
  }
#else
  const hn::FixedTag<float, SIDE> f;
  const auto a = hn::LoadU(f, from);
  const auto b = hn::LoadU(f, from + from_stride);
  const auto c = hn::LoadU(f, from + 2 * from_stride);
  const auto d = hn::LoadU(f, from + 3 * from_stride);
  const auto lower_ab = hn::InterleaveLower(f, a, b);
  const auto lower_cd = hn::InterleaveLower(f, c, d);
  const auto upper_ab = hn::InterleaveUpper(f, a, b);
  const auto upper_cd = hn::InterleaveUpper(f, c, d);
  hn::StoreU(hn::ConcatLowerLower(f, lower_cd, lower_ab), f, to);
  hn::StoreU(hn::ConcatUpperUpper(f, lower_cd, lower_ab), f, to + to_stride);
  hn::StoreU(hn::ConcatLowerLower(f, upper_cd, upper_ab), f, to + 2 * to_stride);
  hn::StoreU(hn::ConcatUpperUpper(f, upper_cd, upper_ab), f, to + 3 * to_stride);
#endif
}

HWY_INLINE void toColumns(const RowTile& rows, std::size_t columns, ColumnTile& tile)
{
  for (std::size_t x = 0; x < columns; x += SIDE)
  {
    for (std::size_t r = 0; r < ROWS; r += SIDE)
    {
      transposeSquare(&rows.at[r][x], RowTile::COLUMNS, &tile.at[x][r], ROWS);
    }
  }
}

HWY_INLINE void toRows(const ColumnTile& columns, RowTile& tile)
{
  for (std::size_t r = 0; r < ROWS; r += SIDE)
  {
    for (std::size_t x = 0; x < TILE_COLUMNS; x += SIDE)
    {
      transposeSquare(&columns.at[x][r], ROWS, &tile.at[r][x], RowTile::COLUMNS);
    }
  }
}

/// No processor foresees which row comes next, far from the last one.
constexpr int ROWS_AHEAD = 4;

HWY_INLINE void prefetchSystem(const SystemRow& row, int first)
{
  constexpr int cache_line = 64 / static_cast<int>(sizeof(float));
  for (int x = first; x < first + TILE_COLUMNS; x += cache_line)
  {
    hwy::Prefetch(row.weight + x);
    hwy::Prefetch(row.target + x);
    hwy::Prefetch(row.left + x);
    hwy::Prefetch(row.up + x);
    hwy::Prefetch(row.down + x);
    hwy::Prefetch(row.above + x);
    hwy::Prefetch(row.below + x);
  }
}

/// What the images say of some unknowns of a row, and their links.
template <class D>
struct Equation
{
  hn::Vec<D> left, right, up, down;
  hn::Vec<D> diagonal;
  hn::Vec<D> own;  ///< of the right side, without the neighbours
};

/// @param row a SystemRow or a ColumnStep
template <class D, class Row>
HWY_INLINE Equation<D> equationAt(D f, const Row& row, int x)
{
  Equation<D> equation;
  const auto data = hn::Add(hn::LoadU(f, row.weight + x), hn::Set(f, TINY_WEIGHT));
  equation.left = hn::LoadU(f, row.left + x);
  equation.right = hn::LoadU(f, row.left + x + 1);
  equation.up = hn::LoadU(f, row.up + x);
  equation.down = hn::LoadU(f, row.down + x);
  const auto across = hn::Add(hn::Add(data, equation.left), equation.right);
  equation.diagonal = hn::Add(hn::Add(across, equation.up), equation.down);
  equation.own = hn::Mul(data, hn::LoadU(f, row.target + x));
  return equation;
}

/// What the row and its neighbours above and below say about the unknowns first .. last - 1.
HWY_INLINE void setSystem(const SystemRow& row, int first, int last, float* left, float* diagonal,
                          float* side)
{
  forPixels(first, last,
            [&](auto f, int x)
            {
              const auto equation = equationAt(f, row, x);
              const auto from_above = hn::Mul(equation.up, hn::LoadU(f, row.above + x));
              const auto from_below = hn::Mul(equation.down, hn::LoadU(f, row.below + x));
              hn::StoreU(equation.left, f, left + x - first);
              hn::StoreU(equation.diagonal, f, diagonal + x - first);
              hn::StoreU(hn::Add(hn::Add(equation.own, from_above), from_below), f, side + x - first);
            });
  left[last - first] = row.left[last];
}

void setSystemTile(const SystemRow* rows, int count, int first, int last, SystemTile& tile)
{
  for (int r = 0; r < count; ++r)
  {
    const int ahead = r + ROWS_AHEAD;
    prefetchSystem(rows[ahead % count], ahead < count ? first : last);
    setSystem(rows[r], first, last, tile.left.at[r], tile.diagonal.at[r], tile.side.at[r]);
  }
  toColumns(tile.left, RowTile::COLUMNS, tile.left_columns);
  toColumns(tile.diagonal, TILE_COLUMNS, tile.diagonal_columns);
  toColumns(tile.side, TILE_COLUMNS, tile.side_columns);
}

/// x = value + factor * (the unknown to the right), of all rows at one column.
struct Elimination
{
  float factor[ROWS];
  float value[ROWS];
};

/// Each step waits for the one before it, so that a processor with several vectors in hand waits less.
void eliminateTile(const SystemTile& tile, int columns, const Elimination& begin, Elimination* eliminations)
{
  const Floats f;
  const auto one = hn::Set(f, 1.0F);
  constexpr std::size_t vectors = ROWS / LANES;
  hn::Vec<Floats> factor[vectors];
  hn::Vec<Floats> value[vectors];
  for (std::size_t v = 0; v < vectors; ++v)
  {
    factor[v] = hn::LoadU(f, begin.factor + v * LANES);
    value[v] = hn::LoadU(f, begin.value + v * LANES);
  }
  for (int x = 0; x < columns; ++x)
  {
    for (std::size_t v = 0; v < vectors; ++v)
    {
      const std::size_t r = v * LANES;
      const auto left = hn::Load(f, tile.left_columns.at[x] + r);
      const auto right = hn::Load(f, tile.left_columns.at[x + 1] + r);
      const auto diagonal = hn::Load(f, tile.diagonal_columns.at[x] + r);
      const auto side = hn::Load(f, tile.side_columns.at[x] + r);
      const auto inverse = hn::Div(one, hn::Sub(diagonal, hn::Mul(left, factor[v])));
      factor[v] = hn::Mul(right, inverse);
      value[v] = hn::Mul(hn::Add(side, hn::Mul(left, value[v])), inverse);
      hn::StoreU(factor[v], f, eliminations[x].factor + r);
      hn::StoreU(value[v], f, eliminations[x].value + r);
    }
  }
}

/// @param next the solution to the right of the tile on entry, that at its first column on return
void substituteTile(const Elimination* eliminations, int columns, float* next, ColumnTile& solution)
{
  const Floats f;
  constexpr std::size_t vectors = ROWS / LANES;
  hn::Vec<Floats> values[vectors];
  for (std::size_t v = 0; v < vectors; ++v)
  {
    values[v] = hn::LoadU(f, next + v * LANES);
  }
  for (int x = columns - 1; x >= 0; --x)
  {
    for (std::size_t v = 0; v < vectors; ++v)
    {
      const auto factor = hn::LoadU(f, eliminations[x].factor + v * LANES);
      values[v] = hn::Add(hn::LoadU(f, eliminations[x].value + v * LANES), hn::Mul(factor, values[v]));
      hn::Store(values[v], f, solution.at[x] + v * LANES);
    }
  }
  for (std::size_t v = 0; v < vectors; ++v)
  {
    hn::StoreU(values[v], f, next + v * LANES);
  }
}

void solveRowsSimd(const SystemRow* rows, int count, int width, float* scratch)
{
  auto* const eliminations = reinterpret_cast<Elimination*>(scratch);
  SystemTile tile = {};
  Elimination begin = {};
  for (int x = 0; x < width; x += TILE_COLUMNS)
  {
    const int last = x + TILE_COLUMNS < width ? x + TILE_COLUMNS : width;
    setSystemTile(rows, count, x, last, tile);
    eliminateTile(tile, last - x, begin, eliminations + x);
    begin = eliminations[last - 1];
  }
  HWY_ALIGN float next[ROWS] = {};
  for (int x = (width - 1) / TILE_COLUMNS * TILE_COLUMNS; x >= 0; x -= TILE_COLUMNS)
  {
    const int last = x + TILE_COLUMNS < width ? x + TILE_COLUMNS : width;
    substituteTile(eliminations + x, last - x, next, tile.side_columns);
    toRows(tile.side_columns, tile.side);
    for (int r = 0; r < count; ++r)
    {
      std::memcpy(rows[r].values + x, tile.side.at[r], sizeof(float) * static_cast<std::size_t>(last - x));
    }
  }
}

template <class D>
HWY_INLINE void eliminateAt(D f, const ColumnStep& step, int x, hn::Vec<D> left_value, hn::Vec<D> right_value)
{
  const int i = x - step.first;
  const auto equation = equationAt(f, step, x);
  const auto beside = hn::Add(equation.own, hn::Mul(equation.left, left_value));
  const auto side = hn::Add(beside, hn::Mul(equation.right, right_value));
  const auto eliminated = hn::Mul(equation.up, hn::LoadU(f, step.factor_above + i));
  const auto inverse = hn::Div(hn::Set(f, 1.0F), hn::Sub(equation.diagonal, eliminated));
  const auto above = hn::Mul(equation.up, hn::LoadU(f, step.value_above + i));
  hn::StoreU(hn::Mul(hn::Add(side, above), inverse), f, step.value + i);
  hn::StoreU(hn::Mul(equation.down, inverse), f, step.factor + i);
}

void eliminateColumnsSimd(const ColumnStep& step)
{
  const OneFloat one;
  const float* const row = step.disparity;
  int first = step.first;
  int last = step.last;
  if (first == 0)
  {
    eliminateAt(one, step, 0, hn::Zero(one), hn::Set(one, step.width > 1 ? row[1] : 0.0F));
    first = 1;
  }
  if (last == step.width && last > first)
  {
    --last;
    eliminateAt(one, step, last, hn::Set(one, row[last - 1]), hn::Zero(one));
  }
  forPixels(first, last,
            [&](auto f, int x)
            { eliminateAt(f, step, x, hn::LoadU(f, row + x - 1), hn::LoadU(f, row + x + 1)); });
}

void substituteColumnsSimd(const float* value, const float* factor, const float* below, int count,
                           float* solution)
{
  forPixels(0, count,
            [&](auto f, int i)
            {
              const auto part = hn::Mul(hn::LoadU(f, factor + i), hn::LoadU(f, below + i));
              hn::StoreU(hn::Add(hn::LoadU(f, value + i), part), f, solution + i);
            });
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(linkRowSimd);
HWY_EXPORT(solveRowsSimd);
HWY_EXPORT(eliminateColumnsSimd);
HWY_EXPORT(substituteColumnsSimd);

void linkRow(const LinkRow& row)
{
  HWY_DYNAMIC_DISPATCH(linkRowSimd)(row);
}

void solveRows(const SystemRow* rows, int count, int width, float* scratch)
{
  HWY_DYNAMIC_DISPATCH(solveRowsSimd)(rows, count, width, scratch);
}

void eliminateColumns(const ColumnStep& step)
{
  HWY_DYNAMIC_DISPATCH(eliminateColumnsSimd)(step);
}

void substituteColumns(const float* value, const float* factor, const float* below, int count,
                       float* solution)
{
  HWY_DYNAMIC_DISPATCH(substituteColumnsSimd)(value, factor, below, count, solution);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
