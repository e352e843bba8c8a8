#include "core/multiview/refine/surface_slopes.h"

#include <algorithm>
#include <cstddef>

#include <opencv2/imgproc.hpp>

#include "core/multiview/refine/slope_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// Of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int CELL_ROWS_PER_CHUNK = 8;
/// Two boxes one after the other fall off towards their ends.
constexpr int BOXES = 2;
/// Keeps the mean defined where the image cuts a cell off from everything.
constexpr float TINY_SHARE = 1e-6F;

}  // namespace

void SurfaceSlopes::find(const cv::Mat& disparity, const cv::Mat& weight, const cv::Mat& guide_left,
                         const cv::Mat& guide_above, const SlopeSettings& settings, ThreadPool& pool)
{
  const int width = disparity.cols;
  const int height = disparity.rows;
  const cv::Size cells(cellCount(width), cellCount(height));
  for (Axis* const axis : {&left_, &above_})
  {
    axis->changes.create(cells, CV_32FC1);
    axis->shares.create(cells, CV_32FC1);
  }
  const auto sumCells =
      [&](int cell_row, bool along_x, Axis& axis, std::vector<float>& changes, std::vector<float>& shares)
  {
    changes.assign(static_cast<std::size_t>(width), 0.0F);
    shares.assign(static_cast<std::size_t>(width), 0.0F);
    for (int y = cell_row * CELL_PX; y < std::min((cell_row + 1) * CELL_PX, height); ++y)
    {
      const int above = std::max(y - 1, 0);
      ChangeRow row;
      row.here = disparity.ptr<float>(y);
      row.before = along_x ? row.here - 1 : disparity.ptr<float>(above);
      row.weight = weight.ptr<float>(y);
      row.weight_before = along_x ? row.weight - 1 : weight.ptr<float>(above);
      row.guide = along_x ? guide_left.ptr<float>(y) : guide_above.ptr<float>(y);
      row.full_weight = settings.full_weight;
      row.soft_px = settings.soft_px;
      row.level_share = settings.level_share;
      row.first = along_x ? 1 : 0;
      row.width = width;
      row.change_sums = changes.data();
      row.share_sums = shares.data();
      addChanges(row);
    }
    std::fill_n(axis.changes.ptr<float>(cell_row), cells.width, 0.0F);
    std::fill_n(axis.shares.ptr<float>(cell_row), cells.width, 0.0F);
    joinColumns(changes, axis.changes.ptr<float>(cell_row));
    joinColumns(shares, axis.shares.ptr<float>(cell_row));
  };
  pool.parallelFor(0, cells.height, CELL_ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     std::vector<float> changes;
                     std::vector<float> shares;
                     for (int row = first; row < last; ++row)
                     {
                       sumCells(row, true, left_, changes, shares);
                       sumCells(row, false, above_, changes, shares);
                     }
                   });
  average(settings, width, pool, left_);
  average(settings, width, pool, above_);
}

void SurfaceSlopes::average(const SlopeSettings& settings, int width, ThreadPool& pool, Axis& axis)
{
  const int side = 2 * (settings.reach_px / CELL_PX) + 1;
  for (cv::Mat* const sums : {&axis.changes, &axis.shares})
  {
    for (int i = 0; i < BOXES; ++i)
    {
      cv::blur(*sums, *sums, {side, side}, {-1, -1}, cv::BORDER_REPLICATE);
    }
  }
  axis.slopes.create(axis.changes.rows, width + 1, CV_32FC1);
  pool.parallelFor(0, axis.slopes.rows, CELL_ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       const auto* const change = axis.changes.ptr<float>(y);
                       const auto* const share = axis.shares.ptr<float>(y);
                       auto* const slope = axis.slopes.ptr<float>(y);
                       for (int x = 0; x < width; ++x)
                       {
                         slope[x] = change[x / CELL_PX] / (share[x / CELL_PX] + TINY_SHARE);
                       }
                       slope[width] = 0.0F;
                     }
                   });
}

}  // namespace light_field_depth::multiview
