#include "core/multiview/refine/edge_aware_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/light_field/pixel_kernels.h"
#include "core/multiview/refine/smoothing_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int ROWS_PER_CHUNK = 16;
/// Rows that are worked on while they are in the cache of a core; even.
constexpr int BAND_ROWS = 2 * ROWS_AT_ONCE;
constexpr int COLUMNS_PER_CHUNK = 128;

}  // namespace

/// Of one chunk at work.
struct EdgeAwareSmoother::Scratch
{
  std::vector<float> eliminations;
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

/// One system, in which rows and columns are solved in turn.
class EdgeAwareSmoother::Sweep
{
public:
  Sweep(EdgeAwareSmoother& smoother, const cv::Mat& weight, const cv::Mat& target, float flat_px,
        ThreadPool& pool, cv::Mat& disparity)
      : smoother_(smoother), weight_(weight), target_(target), flat_px_(flat_px), pool_(pool),
        disparity_(disparity), width_(disparity.cols), height_(disparity.rows)
  {
    smoother_.link_left_.create(height_, width_ + 1, CV_32FC1);
    smoother_.link_above_.create(height_ + 1, width_, CV_32FC1);
    smoother_.link_above_.row(height_).setTo(0.0F);
    smoother_.solution_.create(disparity.size(), CV_32FC1);
  }

  /// Every second row given those between them, then those. A band does both but for its last row, which
  /// waits for the first one of the next band.
  /// @param update_links of this disparity, before anything changes
  void solveRows(bool update_links)
  {
    pool_.parallelFor(0, height_, BAND_ROWS,
                      [&](int first, int last)
                      {
                        if (update_links)
                        {
                          updateLinks(first, last);
                        }
                        solveEverySecond(first, last, 2);
                        solveEverySecond(first + 1, last < height_ ? last - 1 : last, 2);
                      });
    const int bands = (height_ - 1) / BAND_ROWS;
    pool_.parallelFor(0, bands, ROWS_AT_ONCE,
                      [&](int first, int last)
                      { solveEverySecond((first + 1) * BAND_ROWS - 1, last * BAND_ROWS, BAND_ROWS); });
  }

  /// All columns, given the columns beside them before the call.
  void solveColumns()
  {
    pool_.parallelFor(0, width_, COLUMNS_PER_CHUNK,
                      [&](int first, int last) {
                        smoother_.scratch_.use([&](Scratch& scratch) { solveColumns(first, last, scratch); });
                      });
    cv::swap(smoother_.solution_, disparity_);
  }

private:
  void updateLinks(int first, int last)
  {
    for (int y = first; y < last; ++y)
    {
      linkRow({smoother_.guide_left_.ptr<float>(y), smoother_.guide_above_.ptr<float>(y),
               disparity_.ptr<float>(y), disparity_.ptr<float>(std::max(y - 1, 0)), width_, flat_px_,
               smoother_.link_left_.ptr<float>(y), smoother_.link_above_.ptr<float>(y)});
    }
  }

  SystemRow rowOf(int y)
  {
    return {weight_.ptr<float>(y),
            target_.ptr<float>(y),
            smoother_.link_left_.ptr<float>(y),
            smoother_.link_above_.ptr<float>(y),
            smoother_.link_above_.ptr<float>(y + 1),
            disparity_.ptr<float>(std::max(y - 1, 0)),
            disparity_.ptr<float>(std::min(y + 1, height_ - 1)),
            disparity_.ptr<float>(y)};
  }

  /// The rows first, first + step and so on before `last`.
  void solveEverySecond(int first, int last, int step)
  {
    std::array<SystemRow, ROWS_AT_ONCE> rows;
    int count = 0;
    for (int y = first; y < last; y += step)
    {
      rows[static_cast<std::size_t>(count++)] = rowOf(y);
    }
    smoother_.scratch_.use(
        [&](Scratch& scratch)
        {
          scratch.eliminations.resize(std::max(scratch.eliminations.size(), rowScratch(width_)));
          multiview::solveRows(rows.data(), count, width_, scratch.eliminations.data());
        });
  }

  void solveColumns(int first, int last, Scratch& scratch)
  {
    const auto count = static_cast<std::size_t>(last - first);
    const std::size_t size = count * static_cast<std::size_t>(height_);
    scratch.eliminations.resize(std::max(scratch.eliminations.size(), 2 * size));
    float* const factors = scratch.eliminations.data();
    float* const values = factors + size;
    ColumnStep step;
    step.first = first;
    step.last = last;
    step.width = width_;
    step.factor_above = step.value_above = smoother_.link_above_.ptr<float>(0);  // 0, as nothing is above
    step.factor = factors;
    step.value = values;
    for (int y = 0; y < height_; ++y)
    {
      step.weight = weight_.ptr<float>(y);
      step.target = target_.ptr<float>(y);
      step.left = smoother_.link_left_.ptr<float>(y);
      step.up = smoother_.link_above_.ptr<float>(y);
      step.down = smoother_.link_above_.ptr<float>(y + 1);
      step.disparity = disparity_.ptr<float>(y);
      eliminateColumns(step);
      step.factor_above = step.factor;
      step.value_above = step.value;
      step.factor += count;
      step.value += count;
    }
    const float* below = smoother_.link_above_.ptr<float>(height_) + first;  // 0, as nothing is below
    for (int y = height_ - 1; y >= 0; --y)
    {
      const std::size_t line = count * static_cast<std::size_t>(y);
      float* const solution = smoother_.solution_.ptr<float>(y) + first;
      substituteColumns(values + line, factors + line, below, last - first, solution);
      below = solution;
    }
  }

  EdgeAwareSmoother& smoother_;
  const cv::Mat& weight_;
  const cv::Mat& target_;
  float flat_px_;
  ThreadPool& pool_;
  cv::Mat& disparity_;
  int width_;
  int height_;
};

void EdgeAwareSmoother::run(const cv::Mat& weight, const cv::Mat& target, const SmoothingSettings& settings,
                            ThreadPool& pool, cv::Mat& disparity)
{
  Sweep sweep(*this, weight, target, settings.flat_px, pool, disparity);
  for (int i = 0; i < settings.reweightings; ++i)
  {
    for (int k = 0; k < settings.sweeps; ++k)
    {
      sweep.solveRows(k == 0);
      sweep.solveColumns();
    }
  }
}

}  // namespace light_field_depth::multiview
