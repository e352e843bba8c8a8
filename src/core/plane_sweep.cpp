#include "plane_sweep.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sweep_kernels.h"

namespace light_field_depth
{
namespace
{
constexpr int WINDOW_RADIUS = 2;
constexpr int WINDOW_AREA = (2 * WINDOW_RADIUS + 1) * (2 * WINDOW_RADIUS + 1);
constexpr int FRACTION_BITS = 5;
constexpr int FRACTIONS = 1 << FRACTION_BITS;
static_assert(FRACTIONS == BLEND_WEIGHTS, "fractions of a pixel are weights");

/// A displacement split into whole pixels and 32nds.
struct Shift
{
  explicit Shift(float displacement)
  {
    const int fine = static_cast<int>(std::lround(displacement * FRACTIONS));
    whole = fine >> FRACTION_BITS;
    fraction = fine & (FRACTIONS - 1);
  }

  /// The indices of [0, size) whose shifted neighbours are inside as well.
  int first() const { return std::max(0, -whole); }
  int last(int size) const { return std::min(size, size - whole - (fraction != 0 ? 1 : 0)); }

  int whole;
  int fraction;
};

/// The buffers of one label.
class LabelSweeper
{
public:
  explicit LabelSweeper(const PlaneSweep& sweep)
      : sweep_(sweep), width_(sweep.reference.cols), height_(sweep.reference.rows),
        sums_(sweep.reference.total()), columns_(static_cast<std::size_t>(width_) + 2 * WINDOW_RADIUS),
        nothing_(static_cast<std::size_t>(width_)), worst_(sums_.size()), row_a_(nothing_.size() + 1),
        row_b_(row_a_.size())
  {
  }

  void run(int label, std::uint16_t* cost)
  {
    std::fill(cost, cost + sums_.size(), std::uint16_t{0});
    std::fill(worst_.begin(), worst_.end(), std::uint16_t{0});
    for (const SweepArm& arm : sweep_.arms)
    {
      std::fill(sums_.begin(), sums_.end(), std::uint8_t{0});
      for (const SweepView& view : arm)
      {
        addView(view, sweep_.disparity(static_cast<float>(label)));
      }
      addArm(static_cast<int>(arm.size()), cost);
    }
    if (sweep_.arms.size() > 1)
    {
      dropWorst(worst_.data(), static_cast<std::uint16_t>(sweep_.arms.size() - 1), sums_.size(), cost);
    }
  }

private:
  void addView(const SweepView& view, float disparity)
  {
    const Shift shift_x(view.offset.x - disparity * view.steps.x);
    const Shift shift_y(view.offset.y - disparity * view.steps.y);
    const int first = std::min(shift_x.first(), width_);
    const int last = std::max(shift_x.last(width_), first);
    const auto count = static_cast<std::size_t>(last - first);
    for (int y = 0; y < height_; ++y)
    {
      std::uint8_t* const sums = sums_.data() + static_cast<std::ptrdiff_t>(y) * width_;
      if (y < shift_y.first() || y >= shift_y.last(height_) || count == 0)
      {
        addConstant(width_, sums);
        continue;
      }
      addConstant(first, sums);
      addConstant(width_ - last, sums + last);
      const std::uint8_t* const seen = sampleRow(view.image, y + shift_y.whole, first + shift_x.whole,
                                                 shift_y.fraction, shift_x.fraction, count);
      addDifferences(sweep_.reference.ptr<std::uint8_t>(y) + first, seen, SWEEP_TRUNCATION, count,
                     sums + first);
    }
  }

  /// For pixels that the view does not see.
  static void addConstant(int count, std::uint8_t* sums)
  {
    std::for_each(sums, sums + count,
                  [](std::uint8_t& sum) { sum = static_cast<std::uint8_t>(sum + SWEEP_TRUNCATION); });
  }

  const std::uint8_t* sampleRow(const cv::Mat& image, int y, int x, int fraction_y, int fraction_x,
                                std::size_t count)
  {
    const std::uint8_t* row = image.ptr<std::uint8_t>(y) + x;
    if (fraction_y != 0)
    {
      blendBytes(row, image.ptr<std::uint8_t>(y + 1) + x, fraction_y, count + (fraction_x != 0 ? 1 : 0),
                 row_a_.data());
      row = row_a_.data();
    }
    if (fraction_x != 0)
    {
      blendBytes(row, row + 1, fraction_x, count, row_b_.data());
      row = row_b_.data();
    }
    return row;
  }

  /// Averages the sums of an arm over the window, adds them to the cost and keeps the largest.
  void addArm(int views, std::uint16_t* cost)
  {
    constexpr int WORD_RANGE = 1 << 16;
    const auto factor =
        static_cast<std::uint16_t>(SWEEP_COST_PER_GREY_LEVEL * WORD_RANGE / (views * WINDOW_AREA));
    std::fill(columns_.begin(), columns_.end(), std::uint16_t{0});
    std::uint16_t* const inner = columns_.data() + WINDOW_RADIUS;
    const auto width = static_cast<std::size_t>(width_);
    for (int y = -WINDOW_RADIUS; y <= WINDOW_RADIUS; ++y)
    {
      slideColumns(sumsOfRow(y), nothing_.data(), width, inner);
    }
    for (int y = 0; y < height_; ++y)
    {
      if (y > 0)
      {
        slideColumns(sumsOfRow(y + WINDOW_RADIUS), sumsOfRow(y - WINDOW_RADIUS - 1), width, inner);
      }
      std::fill(columns_.begin(), columns_.begin() + WINDOW_RADIUS, inner[0]);
      std::fill(columns_.end() - WINDOW_RADIUS, columns_.end(), inner[width_ - 1]);
      const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(y) * width_;
      addWindows(columns_.data(), factor, width, cost + row, worst_.data() + row);
    }
  }

  /// Rows outside repeat the outermost.
  const std::uint8_t* sumsOfRow(int y) const
  {
    return sums_.data() + static_cast<std::ptrdiff_t>(std::clamp(y, 0, height_ - 1)) * width_;
  }

  const PlaneSweep& sweep_;
  int width_;
  int height_;
  std::vector<std::uint8_t> sums_;  ///< over the views of an arm
  std::vector<std::uint16_t> columns_;
  std::vector<std::uint8_t> nothing_;
  std::vector<std::uint16_t> worst_;
  std::vector<std::uint8_t> row_a_;
  std::vector<std::uint8_t> row_b_;
};

}  // namespace

CostVolume sweepPlanes(const PlaneSweep& sweep, ThreadPool& pool)
{
  constexpr int LABELS_PER_CHUNK = 4;
  CostVolume volume;
  volume.labels = sweep.labels;
  volume.size = sweep.reference.size();
  volume.values.resize(volume.area() * static_cast<std::size_t>(sweep.labels));
  pool.parallelFor(0, sweep.labels, LABELS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     LabelSweeper sweeper(sweep);
                     for (int label = first; label < last; ++label)
                     {
                       sweeper.run(label, volume.cost(label));
                     }
                   });
  return volume;
}

}  // namespace light_field_depth
