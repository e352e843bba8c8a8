#include "light_field_depth/core/multiview/edge_aware_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace light_field_depth::multiview
{
namespace
{
constexpr int ROWS_PER_CHUNK = 16;
constexpr int COLUMNS_PER_CHUNK = 64;
constexpr float TINY_WEIGHT = 1e-3F;  // keeps the system regular where nothing is known

}  // namespace

void EdgeAwareSmoother::setGuide(const PlanarImage& guide, const SmoothingSettings& settings,
                                 ThreadPool& pool)
{
  guide_left_.create(guide.height(), guide.width(), CV_32FC1);
  guide_above_.create(guide.height(), guide.width(), CV_32FC1);
  std::array<float, COLOUR_DIFFERENCES> table{};
  for (std::size_t difference = 0; difference < table.size(); ++difference)
  {
    table[difference] = settings.strength * std::exp(-settings.image_edge_decay *
                                                     static_cast<float>(difference) / COLOUR_DIFFERENCES);
  }
  pool.parallelFor(0, guide.height(), ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     const auto link = [&](const std::uint8_t* a, const std::uint8_t* b)
                     { return table[colourDifference(guide, a, b)]; };
                     for (int y = first; y < last; ++y)
                     {
                       const std::uint8_t* const row = guide.row(y);
                       const std::uint8_t* const above = guide.row(y - 1);
                       auto* const left_links = guide_left_.ptr<float>(y);
                       auto* const above_links = guide_above_.ptr<float>(y);
                       for (int x = 0; x < guide.width(); ++x)
                       {
                         left_links[x] = x > 0 ? link(row + x - 1, row + x) : 0.0F;
                         above_links[x] = y > 0 ? link(above + x, row + x) : 0.0F;
                       }
                     }
                   });
}

void EdgeAwareSmoother::run(const cv::Mat& weight, const cv::Mat& target, const SmoothingSettings& settings,
                            ThreadPool& pool, cv::Mat& disparity)
{
  for (int i = 0; i < settings.reweightings; ++i)
  {
    updateLinks(settings, disparity, pool);
    for (int sweep = 0; sweep < settings.sweeps; ++sweep)
    {
      solveRows(weight, target, 0, pool, disparity);
      solveRows(weight, target, 1, pool, disparity);
      solveColumns(weight, target, pool, disparity);
    }
  }
}

void EdgeAwareSmoother::updateLinks(const SmoothingSettings& settings, const cv::Mat& disparity,
                                    ThreadPool& pool)
{
  link_left_.create(disparity.size(), CV_32FC1);
  link_above_.create(disparity.size(), CV_32FC1);
  const float eps = settings.flat_px;
  pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     const auto robust = [eps](float change)
                     { return eps / std::sqrt(change * change + eps * eps); };
                     for (int y = first; y < last; ++y)
                     {
                       const auto* const row = disparity.ptr<float>(y);
                       const auto* const above = disparity.ptr<float>(std::max(y - 1, 0));
                       const auto* const guide_left = guide_left_.ptr<float>(y);
                       const auto* const guide_above = guide_above_.ptr<float>(y);
                       auto* const left = link_left_.ptr<float>(y);
                       auto* const up = link_above_.ptr<float>(y);
                       left[0] = 0.0F;
                       for (int x = 1; x < disparity.cols; ++x)
                       {
                         left[x] = guide_left[x] * robust(row[x] - row[x - 1]);
                       }
                       for (int x = 0; x < disparity.cols; ++x)
                       {
                         up[x] = guide_above[x] * robust(row[x] - above[x]);
                       }
                     }
                   });
}

/// A row of the system, given the rows above and below.
struct EdgeAwareSmoother::Row
{
  const float* weight;
  const float* target;
  const float* left;
  const float* up;
  const float* down;
  float has_down;
  const float* above;
  const float* below;
  float* values;
};

EdgeAwareSmoother::Row EdgeAwareSmoother::rowOf(const cv::Mat& weight, const cv::Mat& target, int y,
                                                cv::Mat& disparity) const
{
  const bool has_below = y + 1 < disparity.rows;
  const int next = has_below ? y + 1 : y;
  return {weight.ptr<float>(y),
          target.ptr<float>(y),
          link_left_.ptr<float>(y),
          link_above_.ptr<float>(y),
          link_above_.ptr<float>(next),
          has_below ? 1.0F : 0.0F,
          disparity.ptr<float>(std::max(y - 1, 0)),
          disparity.ptr<float>(next),
          disparity.ptr<float>(y)};
}

/// Elimination along COUNT rows at once: each step waits for the one before it, so a processor that has
/// several rows in hand waits less.
template <int COUNT>
void EdgeAwareSmoother::solveTogether(const std::array<Row, ROWS_AT_ONCE>& rows, int width,
                                      std::vector<Elimination>& scratch)
{
  std::array<Elimination, COUNT> before{};
  Elimination* const eliminations = scratch.data();
  for (int x = 0; x < width; ++x)
  {
    for (std::size_t r = 0; r < COUNT; ++r)
    {
      const Row& row = rows[r];
      const float right_link = x + 1 < width ? row.left[x + 1] : 0.0F;
      const float down_link = row.has_down * row.down[x];
      const float data = row.weight[x] + TINY_WEIGHT;
      const float diagonal = data + row.left[x] + right_link + row.up[x] + down_link;
      const float side = data * row.target[x] + row.up[x] * row.above[x] + down_link * row.below[x];
      const float inverse = 1.0F / (diagonal - row.left[x] * before[r].factor);
      before[r].factor = right_link * inverse;
      before[r].value = (side + row.left[x] * before[r].value) * inverse;
      eliminations[static_cast<std::size_t>(x) * COUNT + r] = before[r];
    }
  }
  std::array<float, COUNT> next{};
  for (int x = width - 1; x >= 0; --x)
  {
    for (std::size_t r = 0; r < COUNT; ++r)
    {
      const Elimination& here = eliminations[static_cast<std::size_t>(x) * COUNT + r];
      next[r] = here.value + here.factor * next[r];
      rows[r].values[x] = next[r];
    }
  }
}

/// Every second row, given the rows between them.
void EdgeAwareSmoother::solveRows(const cv::Mat& weight, const cv::Mat& target, int parity, ThreadPool& pool,
                                  cv::Mat& disparity) const
{
  const int width = disparity.cols;
  const int pairs = (disparity.rows - parity + 1) / 2;
  pool.parallelFor(0, pairs, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     std::vector<Elimination> scratch(ROWS_AT_ONCE * static_cast<std::size_t>(width));
                     std::array<Row, ROWS_AT_ONCE> rows{};
                     int pair = first;
                     for (; pair + ROWS_AT_ONCE <= last; pair += ROWS_AT_ONCE)
                     {
                       for (int r = 0; r < ROWS_AT_ONCE; ++r)
                       {
                         rows[static_cast<std::size_t>(r)] =
                             rowOf(weight, target, 2 * (pair + r) + parity, disparity);
                       }
                       solveTogether<ROWS_AT_ONCE>(rows, width, scratch);
                     }
                     for (; pair < last; ++pair)
                     {
                       rows[0] = rowOf(weight, target, 2 * pair + parity, disparity);
                       solveTogether<1>(rows, width, scratch);
                     }
                   });
}

/// All columns, given the columns beside them before the call.
void EdgeAwareSmoother::solveColumns(const cv::Mat& weight, const cv::Mat& target, ThreadPool& pool,
                                     cv::Mat& disparity)
{
  const int width = disparity.cols;
  const int height = disparity.rows;
  elimination_.create(disparity.size(), CV_32FC1);
  solution_.create(disparity.size(), CV_32FC1);
  const auto forward = [&](int y, int first, int last)
  {
    const auto* const w = weight.ptr<float>(y);
    const auto* const t = target.ptr<float>(y);
    const auto* const left = link_left_.ptr<float>(y);
    const auto* const up = link_above_.ptr<float>(y);
    const auto* const row = disparity.ptr<float>(y);
    const bool has_below = y + 1 < height;
    const auto* const down = link_above_.ptr<float>(has_below ? y + 1 : y);
    const float has_down = has_below ? 1.0F : 0.0F;
    const auto* const before_factor = y > 0 ? elimination_.ptr<float>(y - 1) : up;  // up is 0 there
    const auto* const before_value = y > 0 ? solution_.ptr<float>(y - 1) : up;
    auto* const factor = elimination_.ptr<float>(y);
    auto* const value = solution_.ptr<float>(y);
    const auto element = [&](int x, float left_value, float right_link, float right_value)
    {
      const float data = w[x] + TINY_WEIGHT;
      const float down_link = has_down * down[x];
      const float diagonal = data + left[x] + right_link + up[x] + down_link;
      const float side = data * t[x] + left[x] * left_value + right_link * right_value;
      const float inverse = 1.0F / (diagonal - up[x] * before_factor[x]);
      const float above = up[x] * before_value[x];
      value[x] = (side + above) * inverse;
      factor[x] = down_link * inverse;
    };
    int begin = first;
    int end = last;
    if (begin == 0)
    {
      element(0, 0.0F, left[1], row[1]);
      begin = 1;
    }
    if (end == width)
    {
      --end;
      element(end, row[end - 1], 0.0F, 0.0F);
    }
    for (int x = begin; x < end; ++x)
    {
      element(x, row[x - 1], left[x + 1], row[x + 1]);
    }
  };
  pool.parallelFor(0, width, COLUMNS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = 0; y < height; ++y)
                     {
                       forward(y, first, last);
                     }
                     for (int y = height - 2; y >= 0; --y)
                     {
                       const auto* const factor = elimination_.ptr<float>(y);
                       const auto* const below = solution_.ptr<float>(y + 1);
                       auto* const value = solution_.ptr<float>(y);
                       for (int x = first; x < last; ++x)
                       {
                         value[x] += factor[x] * below[x];
                       }
                     }
                   });
  cv::swap(solution_, disparity);
}

}  // namespace light_field_depth::multiview
