#include "core/multiview/refine/noise_discount.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/multiview/refine/cell_sums.h"
#include "core/multiview/refine/noise_discount_kernels.h"
#include "core/multiview/refine/normal_equation_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// Of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int CELL_ROWS_PER_CHUNK = 8;
/// Cells on each side of one whose sums are compared: about 20 x 20 pixels in all.
constexpr int REACH_CELLS = 2;
/// Where there is no noise every curvature is more than it adds.
constexpr float TINY_NOISE = 1e-6F;

}  // namespace

void NoiseDiscount::apply(const NoiseDiscountSettings& settings, ThreadPool& pool,
                          Linearization& linearization)
{
  sumCells(linearization, pool);
  findShare(settings, pool);
  cv::Mat& weight = linearization.weight;
  const auto discount = [&](int row, Scratch& share)
  {
    share.resize(static_cast<std::size_t>(weight.cols));
    const auto* const of_cells = share_.ptr<float>(row);
    for (int x = 0; x < weight.cols; ++x)
    {
      share[static_cast<std::size_t>(x)] = of_cells[x / CELL_PX];
    }
    for (int y = row * CELL_PX; y < std::min((row + 1) * CELL_PX, weight.rows); ++y)
    {
      discountRow({linearization.noise.ptr<float>(y), share.data(), settings.margin, settings.max_weight,
                   weight.cols, weight.ptr<float>(y)});
    }
  };
  pool.parallelFor(0, share_.rows, CELL_ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     scratch_.use(
                         [&](Scratch& scratch)
                         {
                           for (int row = first; row < last; ++row)
                           {
                             discount(row, scratch);
                           }
                         });
                   });
}

void NoiseDiscount::sumCells(const Linearization& linearization, ThreadPool& pool)
{
  const int width = linearization.weight.cols;
  const int height = linearization.weight.rows;
  for (cv::Mat* const sums : {&curvature_, &noise_, &share_})
  {
    sums->create(cellCount(height), cellCount(width), CV_32FC1);
  }
  const auto sumRow = [&](int row)
  {
    std::vector<float> curvature(static_cast<std::size_t>(width), 0.0F);
    std::vector<float> noise(static_cast<std::size_t>(width), 0.0F);
    for (int y = row * CELL_PX; y < std::min((row + 1) * CELL_PX, height); ++y)
    {
      addCapped(linearization.weight.ptr<float>(y), linearization.noise.ptr<float>(y), width,
                curvature.data(), noise.data());
    }
    std::fill_n(curvature_.ptr<float>(row), curvature_.cols, 0.0F);
    std::fill_n(noise_.ptr<float>(row), noise_.cols, 0.0F);
    joinColumns(curvature, curvature_.ptr<float>(row));
    joinColumns(noise, noise_.ptr<float>(row));
  };
  pool.parallelFor(0, curvature_.rows, CELL_ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int row = first; row < last; ++row)
                     {
                       sumRow(row);
                     }
                   });
}

/// From the sums over the cells about each.
void NoiseDiscount::findShare(const NoiseDiscountSettings& settings, ThreadPool& pool)
{
  const int width = share_.cols;
  const auto boxSum = [&](const cv::Mat& sums, int row, std::vector<float>& columns, std::vector<float>& box)
  {
    std::array<const float*, 2 * REACH_CELLS + 1> rows{};
    int count = 0;
    for (int y = std::max(row - REACH_CELLS, 0); y <= std::min(row + REACH_CELLS, sums.rows - 1); ++y)
    {
      rows[static_cast<std::size_t>(count++)] = sums.ptr<float>(y);
    }
    sumRows(rows.data(), count, columns.size(), columns.data());
    boxRow(columns.data(), width, REACH_CELLS, box.data());
  };
  const float ramp = 1.0F / (settings.full_from - settings.nothing_below);
  pool.parallelFor(0, share_.rows, CELL_ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     std::vector<float> columns(static_cast<std::size_t>(width));
                     std::vector<float> curvature(columns);
                     std::vector<float> noise(columns);
                     for (int row = first; row < last; ++row)
                     {
                       boxSum(curvature_, row, columns, curvature);
                       boxSum(noise_, row, columns, noise);
                       auto* const share = share_.ptr<float>(row);
                       for (std::size_t x = 0; x < columns.size(); ++x)
                       {
                         const bool clean = noise[x] < TINY_NOISE;
                         const float ratio = clean ? settings.full_from : curvature[x] / noise[x];
                         share[x] = std::clamp((ratio - settings.nothing_below) * ramp, 0.0F, 1.0F);
                       }
                     }
                   });
}

}  // namespace light_field_depth::multiview
