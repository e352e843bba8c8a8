#include "core/multiview/refine/edge_aware_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/light_field/pixel_kernels.h"
#include "core/multiview/refine/slope_kernels.h"
#include "core/multiview/refine/smoothing_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;

}  // namespace

/// Of one chunk at work.
struct EdgeAwareSmoother::Scratch
{
  std::vector<std::uint16_t> from_left;
  std::vector<std::uint16_t> from_above;
};

EdgeAwareSmoother::EdgeAwareSmoother() = default;
EdgeAwareSmoother::~EdgeAwareSmoother() = default;

void EdgeAwareSmoother::setGuide(const PlanarImage& guide, const SmoothingSettings& settings,
                                 ThreadPool& pool)
{
  const int width = guide.width();
  guide_left_.create(guide.height(), width, CV_32FC1);
  guide_above_.create(guide.height(), width, CV_32FC1);
  std::array<float, COLOUR_DIFFERENCES> table{};
  for (std::size_t difference = 0; difference < table.size(); ++difference)
  {
    table[difference] = settings.strength * std::exp(-settings.image_edge_decay *
                                                     static_cast<float>(difference) / COLOUR_DIFFERENCES);
  }
  const auto setRow = [&](int y, Scratch& scratch)
  {
    const std::uint8_t* const row = guide.row(y);
    colourChanges({row, guide.row(y - 1), guide.channelStride(), guide.channels(), width},
                  scratch.from_left.data(), scratch.from_above.data());
    const auto link = [&](std::uint16_t change) { return table[change]; };
    std::transform(scratch.from_left.begin(), scratch.from_left.end(), guide_left_.ptr<float>(y), link);
    std::transform(scratch.from_above.begin(), scratch.from_above.end(), guide_above_.ptr<float>(y), link);
    guide_left_.at<float>(y, 0) = 0.0F;
  };
  pool.parallelFor(0, guide.height(), ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     scratch_.use(
                         [&](Scratch& scratch)
                         {
                           scratch.from_left.resize(static_cast<std::size_t>(width));
                           scratch.from_above.resize(static_cast<std::size_t>(width));
                           for (int y = first; y < last; ++y)
                           {
                             setRow(y, scratch);
                           }
                         });
                   });
  guide_above_.row(0).setTo(0.0F);
}

void EdgeAwareSmoother::run(const cv::Mat& weight, const cv::Mat& target, const SmoothingSettings& settings,
                            ThreadPool& pool, cv::Mat& disparity)
{
  link_left_.create(disparity.rows, disparity.cols + 1, CV_32FC1);
  link_above_.create(disparity.rows + 1, disparity.cols, CV_32FC1);
  link_above_.row(disparity.rows).setTo(0.0F);
  level_.assign(static_cast<std::size_t>(disparity.cols), 0.0F);
  for (std::size_t i = 0; i < settings.flat_px.size(); ++i)
  {
    const float flat_px = settings.flat_px[i];
    const bool lean = settings.follow_slopes && i > 0;
    if (lean)
    {
      slopes_.find(disparity, weight, guide_left_, guide_above_, settings.slopes, pool);
      pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                       [&](int first, int last) { updateLinks(disparity, flat_px, lean, first, last); });
      leanTargets(weight, target, pool);
    }
    const LinkedGrid grid{weight, lean ? leaning_ : target, link_left_, link_above_, disparity};
    const auto link = [&](int first, int last) { updateLinks(disparity, flat_px, lean, first, last); };
    lines_.solveRows(grid, lean ? LineSolver::PrepareBand() : link, pool);
    lines_.solveColumns(grid, pool);
    coarse_.correct(grid, pool);
    lines_.solveRows(grid, {}, pool);
    lines_.solveColumns(grid, pool);
  }
}

void EdgeAwareSmoother::updateLinks(const cv::Mat& disparity, float flat_px, bool lean, int first, int last)
{
  for (int y = first; y < last; ++y)
  {
    linkRow({guide_left_.ptr<float>(y), guide_above_.ptr<float>(y), disparity.ptr<float>(y),
             disparity.ptr<float>(std::max(y - 1, 0)), lean ? slopes_.left(y) : level_.data(),
             lean ? slopes_.above(y) : level_.data(), disparity.cols, flat_px, link_left_.ptr<float>(y),
             link_above_.ptr<float>(y)});
  }
}

void EdgeAwareSmoother::leanTargets(const cv::Mat& weight, const cv::Mat& target, ThreadPool& pool)
{
  leaning_.create(target.size(), CV_32FC1);
  pool.parallelFor(0, target.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       leanRow({target.ptr<float>(y), weight.ptr<float>(y), link_left_.ptr<float>(y),
                                link_above_.ptr<float>(y), link_above_.ptr<float>(y + 1), slopes_.left(y),
                                slopes_.above(y), slopes_.above(std::min(y + 1, target.rows - 1)),
                                target.cols, leaning_.ptr<float>(y)});
                     }
                   });
}

}  // namespace light_field_depth::multiview
