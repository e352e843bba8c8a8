#include "core/multiview/refine/line_solver.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace light_field_depth::multiview
{
namespace
{
/// Rows that are worked on while they are in the cache of a core; even.
constexpr int BAND_ROWS = 2 * ROWS_AT_ONCE;
/// Of one task. Set by hand: whole cache lines, and enough tasks for every thread; results do not depend on
/// it.
constexpr int COLUMNS_PER_CHUNK = 128;

void solveColumnRange(const LinkedGrid& grid, int first, int last, std::vector<float>& scratch,
                      cv::Mat& solution)
{
  const int height = grid.values.rows;
  const auto count = static_cast<std::size_t>(last - first);
  const std::size_t size = count * static_cast<std::size_t>(height);
  scratch.resize(std::max(scratch.size(), 2 * size));
  float* const factors = scratch.data();
  float* const values = factors + size;
  ColumnStep step;
  step.first = first;
  step.last = last;
  step.width = grid.values.cols;
  step.factor_above = step.value_above = grid.up.ptr<float>(0);  // 0, as nothing is above
  step.factor = factors;
  step.value = values;
  for (int y = 0; y < height; ++y)
  {
    step.weight = grid.weight.ptr<float>(y);
    step.target = grid.target.ptr<float>(y);
    step.left = grid.left.ptr<float>(y);
    step.up = grid.up.ptr<float>(y);
    step.down = grid.up.ptr<float>(y + 1);
    step.disparity = grid.values.ptr<float>(y);
    eliminateColumns(step);
    step.factor_above = step.factor;
    step.value_above = step.value;
    step.factor += count;
    step.value += count;
  }
  const float* below = grid.up.ptr<float>(height) + first;  // 0, as nothing is below
  for (int y = height - 1; y >= 0; --y)
  {
    const std::size_t line = count * static_cast<std::size_t>(y);
    float* const row = solution.ptr<float>(y) + first;
    substituteColumns(values + line, factors + line, below, last - first, row);
    below = row;
  }
}

}  // namespace

SystemRow systemRow(const LinkedGrid& grid, int y)
{
  return {grid.weight.ptr<float>(y),
          grid.target.ptr<float>(y),
          grid.left.ptr<float>(y),
          grid.up.ptr<float>(y),
          grid.up.ptr<float>(y + 1),
          grid.values.ptr<float>(std::max(y - 1, 0)),
          grid.values.ptr<float>(std::min(y + 1, grid.values.rows - 1)),
          grid.values.ptr<float>(y)};
}

void LineSolver::solveRows(const LinkedGrid& grid, const PrepareBand& prepare, ThreadPool& pool)
{
  const int height = grid.values.rows;
  pool.parallelFor(0, height, BAND_ROWS,
                   [&](int first, int last)
                   {
                     if (prepare)
                     {
                       prepare(first, last);
                     }
                     solveEverySecond(grid, first, last, 2);
                     solveEverySecond(grid, first + 1, last < height ? last - 1 : last, 2);
                   });
  const int bands = (height - 1) / BAND_ROWS;
  pool.parallelFor(0, bands, ROWS_AT_ONCE,
                   [&](int first, int last)
                   { solveEverySecond(grid, (first + 1) * BAND_ROWS - 1, last * BAND_ROWS, BAND_ROWS); });
}

void LineSolver::solveColumns(const LinkedGrid& grid, ThreadPool& pool)
{
  solution_.create(grid.values.size(), CV_32FC1);
  pool.parallelFor(0, grid.values.cols, COLUMNS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     scratch_.use([&](std::vector<float>& scratch)
                                  { solveColumnRange(grid, first, last, scratch, solution_); });
                   });
  cv::swap(solution_, grid.values);
}

/// The rows first, first + step and so on before `last`.
void LineSolver::solveEverySecond(const LinkedGrid& grid, int first, int last, int step)
{
  std::array<SystemRow, ROWS_AT_ONCE> rows;
  int count = 0;
  for (int y = first; y < last; y += step)
  {
    rows[static_cast<std::size_t>(count++)] = systemRow(grid, y);
  }
  const int width = grid.values.cols;
  scratch_.use(
      [&](std::vector<float>& scratch)
      {
        scratch.resize(std::max(scratch.size(), rowScratch(width)));
        multiview::solveRows(rows.data(), count, width, scratch.data());
      });
}

}  // namespace light_field_depth::multiview
