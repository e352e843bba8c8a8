#include "core/preprocess/plane_sweep.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/preprocess/sweep_kernels.h"

namespace light_field_depth
{
namespace
{
constexpr int WINDOW_SIDE = 2 * SWEEP_WINDOW_RADIUS + 1;  // px
/// 1/32 pixel: a sixteenth of a label (LABEL_DISPLACEMENT).
constexpr int FRACTION_BITS = 5;
static_assert(SWEEP_FRACTIONS == 1 << FRACTION_BITS, "whole pixels and fractions are split by a shift");

/// A displacement split into whole pixels and fractions.
struct Shift
{
  explicit Shift(float displacement)
  {
    const int fine = static_cast<int>(std::lround(displacement * SWEEP_FRACTIONS));
    whole = fine >> FRACTION_BITS;
    fraction = fine & (SWEEP_FRACTIONS - 1);
  }

  /// The indices of [0, size) whose shifted neighbours are inside as well.
  int first() const { return std::max(0, -whole); }
  int last(int size) const { return std::min(size, size - whole - (fraction != 0 ? 1 : 0)); }

  int whole;
  int fraction;
};

/// A copy of an image with bytes beyond its rows that may be read.
cv::Mat padded(const cv::Mat& image)
{
  cv::Mat wide(image.rows, image.cols + SWEEP_ROW_PADDING, CV_8UC1);
  cv::Mat inside = wide.colRange(0, image.cols);
  image.copyTo(inside);
  wide.colRange(image.cols, wide.cols).setTo(0);
  return inside;
}

/// The sweep with padded images.
PlaneSweep paddedSweep(const PlaneSweep& sweep)
{
  PlaneSweep result = sweep;
  result.reference = padded(sweep.reference);
  for (SweepArm& arm : result.arms)
  {
    std::for_each(arm.begin(), arm.end(), [](SweepView& view) { view.image = padded(view.image); });
  }
  return result;
}

/// The buffers of one label.
class LabelSweeper
{
public:
  /// @param sweep of padded images
  explicit LabelSweeper(const PlaneSweep& sweep)
      : sweep_(sweep), width_(sweep.reference.cols), height_(sweep.reference.rows),
        columns_(sweep.arms.size() * columnsOfWindows(width_))
  {
    for (const SweepArm& arm : sweep.arms)
    {
      sums_.emplace_back(height_, width_ + 2 * SWEEP_WINDOW_RADIUS + SWEEP_ROW_PADDING, CV_8UC1);
      arms_.push_back({{sums_.back().ptr<std::uint8_t>(), static_cast<std::ptrdiff_t>(sums_.back().step[0])},
                       factorOf(arm)});
    }
  }

  void run(int label, std::uint16_t* cost)
  {
    const float disparity = sweep_.disparity(static_cast<float>(label));
    for (std::size_t arm = 0; arm < arms_.size(); ++arm)
    {
      sumUp(sweep_.arms[arm], disparity, sums_[arm]);
    }
    meanOfWindows(arms_.data(), arms_.size(), width_, height_, columns_.data(), cost);
  }

private:
  static std::uint16_t factorOf(const SweepArm& arm)
  {
    constexpr int WORD_RANGE = 1 << 16;  // what meanOfWindows() divides by
    const int area = static_cast<int>(arm.size()) * WINDOW_SIDE * WINDOW_SIDE;
    return static_cast<std::uint16_t>(SWEEP_COST_PER_GREY_LEVEL * WORD_RANGE / area);
  }

  void sumUp(const SweepArm& arm, float disparity, cv::Mat& sums) const
  {
    const auto unseen = static_cast<std::uint8_t>(SWEEP_TRUNCATION * arm.size());
    std::fill_n(sums.data, sums.total(), unseen);
    for (const SweepView& view : arm)
    {
      subtractView(view, disparity, sums);
    }
    for (int y = 0; y < height_; ++y)
    {
      std::uint8_t* const row = sums.ptr<std::uint8_t>(y);
      std::fill(row, row + SWEEP_WINDOW_RADIUS, row[SWEEP_WINDOW_RADIUS]);
      std::uint8_t* const end = row + SWEEP_WINDOW_RADIUS + width_;
      std::fill(end, end + SWEEP_WINDOW_RADIUS, end[-1]);
    }
  }

  void subtractView(const SweepView& view, float disparity, cv::Mat& sums) const
  {
    const Shift shift_x(view.offset.x - disparity * view.steps.x);
    const Shift shift_y(view.offset.y - disparity * view.steps.y);
    const cv::Point first(shift_x.first(), shift_y.first());
    const cv::Point last(shift_x.last(width_), shift_y.last(height_));
    if (first.x >= last.x || first.y >= last.y)
    {
      return;
    }
    const cv::Mat& seen = view.image;
    const cv::Mat& reference = sweep_.reference;
    const SweptBlock block = {
        {reference.ptr<std::uint8_t>(first.y) + first.x, static_cast<std::ptrdiff_t>(reference.step[0])},
        {seen.ptr<std::uint8_t>(first.y + shift_y.whole) + first.x + shift_x.whole,
         static_cast<std::ptrdiff_t>(seen.step[0])},
        shift_x.fraction,
        shift_y.fraction,
        last.x - first.x,
        last.y - first.y};
    subtractLikeness(block, SWEEP_TRUNCATION,
                     {sums.ptr<std::uint8_t>(first.y) + SWEEP_WINDOW_RADIUS + first.x,
                      static_cast<std::ptrdiff_t>(sums.step[0])});
  }

  const PlaneSweep& sweep_;
  int width_;
  int height_;
  std::vector<cv::Mat> sums_;           ///< of each arm over its views, as meanOfWindows() wants them
  std::vector<ArmSums> arms_;           ///< the same
  std::vector<std::uint16_t> columns_;  ///< memory of meanOfWindows()
};

}  // namespace

SweepCosts sweepPlanes(const PlaneSweep& sweep, ThreadPool& pool)
{
  /// Labels of one task. Set by hand: enough tasks for every thread; results do not depend on it.
  constexpr int LABELS_PER_CHUNK = 1;
  SweepCosts volume;
  volume.labels = sweep.labels;
  volume.size = sweep.reference.size();
  volume.values.create(sweep.labels, volume.size.area(), CV_16UC1);
  const PlaneSweep readable = paddedSweep(sweep);
  pool.parallelFor(0, sweep.labels, LABELS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     LabelSweeper sweeper(readable);
                     for (int label = first; label < last; ++label)
                     {
                       sweeper.run(label, volume.cost(label));
                     }
                   });
  return volume;
}

}  // namespace light_field_depth
