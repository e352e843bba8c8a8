#include "core/multiview/refine/coarse_correction.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "core/multiview/refine/coarse_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;
/// Enough for what is left on the coarsest grid; on the others one sweep follows each correction.
constexpr int COARSEST_SWEEPS = 10;
/// Twice the correction is the most that constant prolongation falls short by.
constexpr double MAX_STEP = 2.0;

}  // namespace

/// Of one chunk of rows at work.
struct CoarseCorrection::Scratch
{
  std::vector<float> sums;
};

struct CoarseCorrection::Level
{
  cv::Mat weight;
  cv::Mat target;
  cv::Mat left;
  cv::Mat up;
  cv::Mat values;
  LineSolver solver;

  LinkedGrid grid() { return {weight, target, left, up, values}; }

  void sweep(ThreadPool& pool)
  {
    solver.solveRows(grid(), {}, pool);
    solver.solveColumns(grid(), pool);
  }
};

CoarseCorrection::CoarseCorrection() = default;
CoarseCorrection::~CoarseCorrection() = default;

void CoarseCorrection::correct(const LinkedGrid& grid, ThreadPool& pool)
{
  std::size_t count = 0;
  for (cv::Size size = grid.values.size(); std::min(size.width, size.height) > SMALLEST_SIDE_PX; ++count)
  {
    size = {(size.width + 1) / 2, (size.height + 1) / 2};
    if (levels_.size() <= count)
    {
      levels_.push_back(std::make_unique<Level>());
    }
    coarsen(count == 0 ? grid : levels_[count - 1]->grid(), *levels_[count], pool);
  }
  if (count == 0)
  {
    return;
  }
  for (int i = 0; i < COARSEST_SWEEPS; ++i)
  {
    levels_[count - 1]->sweep(pool);
  }
  for (std::size_t level = count - 1; level > 0; --level)
  {
    spread(*levels_[level], 1.0F, pool, levels_[level - 1]->values);
    levels_[level - 1]->sweep(pool);
  }
  spread(*levels_[0], bestStep(*levels_[0], pool), pool, grid.values);
}

/// The system of the cells of 2 x 2, with no correction yet.
void CoarseCorrection::coarsen(const LinkedGrid& fine, Level& level, ThreadPool& pool)
{
  const int width = fine.values.cols;
  const int height = fine.values.rows;
  const cv::Size size((width + 1) / 2, (height + 1) / 2);
  level.weight.create(size, CV_32FC1);
  level.target.create(size, CV_32FC1);
  level.left.create(size.height, size.width + 1, CV_32FC1);
  level.up.create(size.height + 1, size.width, CV_32FC1);
  level.up.row(size.height).setTo(0.0F);
  level.values.create(size, CV_32FC1);
  const auto coarsenRow = [&](int y, std::vector<float>& scratch)
  {
    const auto stride = static_cast<std::size_t>(width);
    const CellSums sums{scratch.data(), scratch.data() + stride, scratch.data() + 2 * stride};
    sumResiduals(systemRow(fine, 2 * y), width, false, sums);
    if (2 * y + 1 < height)
    {
      sumResiduals(systemRow(fine, 2 * y + 1), width, true, sums);
    }
    joinCells({sums, fine.up.ptr<float>(2 * y), width, level.weight.ptr<float>(y), level.target.ptr<float>(y),
               level.left.ptr<float>(y), level.up.ptr<float>(y)});
    std::fill_n(level.values.ptr<float>(y), size.width, 0.0F);
  };
  pool.parallelFor(
      0, size.height, ROWS_PER_CHUNK,
      [&](int first, int last)
      {
        scratch_.use(
            [&](Scratch& scratch)
            {
              scratch.sums.resize(std::max(scratch.sums.size(), 3 * static_cast<std::size_t>(width)));
              for (int y = first; y < last; ++y)
              {
                coarsenRow(y, scratch.sums);
              }
            });
      });
}

void CoarseCorrection::spread(const Level& level, float factor, ThreadPool& pool, cv::Mat& fine)
{
  pool.parallelFor(0, fine.rows, 4 * ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       spreadRow(level.values.ptr<float>(y / 2), factor, fine.cols, fine.ptr<float>(y));
                     }
                   });
}

/// The part of the correction that lowers the energy of the fine grid most.
float CoarseCorrection::bestStep(Level& level, ThreadPool& pool)
{
  const int height = level.values.rows;
  const auto width = static_cast<std::size_t>(level.values.cols);
  const auto chunks = static_cast<std::size_t>((height + ROWS_PER_CHUNK - 1) / ROWS_PER_CHUNK);
  gains_.assign(chunks, 0.0);
  charges_.assign(chunks, 0.0);
  const LinkedGrid grid = level.grid();
  const auto sum = [&](int first, int last, std::vector<float>& columns)
  {
    columns.assign(2 * width, 0.0F);
    for (int y = first; y < last; ++y)
    {
      sumGains(systemRow(grid, y), level.values.cols, columns.data(), columns.data() + width);
    }
    const auto chunk = static_cast<std::size_t>(first / ROWS_PER_CHUNK);
    const auto middle = columns.begin() + static_cast<std::ptrdiff_t>(width);
    gains_[chunk] = std::accumulate(columns.begin(), middle, 0.0);
    charges_[chunk] = std::accumulate(middle, columns.end(), 0.0);
  };
  pool.parallelFor(0, height, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   { scratch_.use([&](Scratch& scratch) { sum(first, last, scratch.sums); }); });
  const double gain = std::accumulate(gains_.begin(), gains_.end(), 0.0);
  const double charge = std::accumulate(charges_.begin(), charges_.end(), 0.0);
  return charge > 0.0 ? static_cast<float>(std::clamp(gain / charge, 0.0, MAX_STEP)) : 0.0F;
}

}  // namespace light_field_depth::multiview
