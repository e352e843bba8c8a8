#include "plane_sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace light_field_depth
{
namespace
{
constexpr int WINDOW_RADIUS = 2;
constexpr int WINDOW_AREA = (2 * WINDOW_RADIUS + 1) * (2 * WINDOW_RADIUS + 1);
constexpr int FRACTION_BITS = 5;
constexpr int FRACTIONS = 1 << FRACTION_BITS;

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

void blend(const std::uint8_t* a, const std::uint8_t* b, int weight_b, int count, std::uint8_t* out)
{
  const int weight_a = FRACTIONS - weight_b;
  for (int x = 0; x < count; ++x)
  {
    out[x] = static_cast<std::uint8_t>((a[x] * weight_a + b[x] * weight_b + FRACTIONS / 2) >> FRACTION_BITS);
  }
}

void addDifferences(const std::uint8_t* a, const std::uint8_t* b, int count, std::uint16_t* sums)
{
  for (int x = 0; x < count; ++x)
  {
    const int difference = std::abs(a[x] - b[x]);
    sums[x] = static_cast<std::uint16_t>(sums[x] + std::min(difference, SWEEP_TRUNCATION));
  }
}

void addConstant(std::uint16_t value, int count, std::uint16_t* sums)
{
  for (int x = 0; x < count; ++x)
  {
    sums[x] = static_cast<std::uint16_t>(sums[x] + value);
  }
}

/// The buffers of one label.
class LabelSweeper
{
public:
  explicit LabelSweeper(const PlaneSweep& sweep)
      : sweep_(sweep), width_(sweep.reference.cols), height_(sweep.reference.rows),
        sums_(sweep.reference.total()), columns_(static_cast<std::size_t>(width_) + 2 * WINDOW_RADIUS),
        worst_(sums_.size()), row_a_(static_cast<std::size_t>(width_) + 1),
        row_b_(static_cast<std::size_t>(width_) + 1)
  {
  }

  void run(int label, std::uint16_t* cost)
  {
    std::fill(cost, cost + sums_.size(), std::uint16_t{0});
    std::fill(worst_.begin(), worst_.end(), std::uint16_t{0});
    for (const SweepArm& arm : sweep_.arms)
    {
      std::fill(sums_.begin(), sums_.end(), std::uint16_t{0});
      for (const SweepView& view : arm)
      {
        addView(view, sweep_.disparity(static_cast<float>(label)));
      }
      addArm(static_cast<int>(arm.size()), cost);
    }
    dropWorst(cost);
  }

private:
  void addView(const SweepView& view, float disparity)
  {
    const Shift shift_x(view.offset.x - disparity * view.steps.x);
    const Shift shift_y(view.offset.y - disparity * view.steps.y);
    const int first = std::min(shift_x.first(), width_);
    const int last = std::max(shift_x.last(width_), first);
    for (int y = 0; y < height_; ++y)
    {
      std::uint16_t* const sums = sums_.data() + static_cast<std::ptrdiff_t>(y) * width_;
      if (y < shift_y.first() || y >= shift_y.last(height_))
      {
        addConstant(SWEEP_TRUNCATION, width_, sums);
        continue;
      }
      addConstant(SWEEP_TRUNCATION, first, sums);
      addConstant(SWEEP_TRUNCATION, width_ - last, sums + last);
      const std::uint8_t* const seen = sampleRow(view.image, y + shift_y.whole, first + shift_x.whole,
                                                 shift_y.fraction, shift_x.fraction, last - first);
      addDifferences(sweep_.reference.ptr<std::uint8_t>(y) + first, seen, last - first, sums + first);
    }
  }

  const std::uint8_t* sampleRow(const cv::Mat& image, int y, int x, int fraction_y, int fraction_x, int count)
  {
    const std::uint8_t* row = image.ptr<std::uint8_t>(y) + x;
    if (count <= 0)
    {
      return row;
    }
    if (fraction_y != 0)
    {
      blend(row, image.ptr<std::uint8_t>(y + 1) + x, fraction_y, count + (fraction_x != 0 ? 1 : 0),
            row_a_.data());
      row = row_a_.data();
    }
    if (fraction_x != 0)
    {
      blend(row, row + 1, fraction_x, count, row_b_.data());
      row = row_b_.data();
    }
    return row;
  }

  /// Averages the sums of an arm over the window, adds them to the cost and keeps the largest.
  void addArm(int views, std::uint16_t* cost)
  {
    const int scale = SWEEP_COST_PER_GREY_LEVEL * FRACTIONS * FRACTIONS / (views * WINDOW_AREA);
    std::fill(columns_.begin(), columns_.end(), std::uint16_t{0});
    std::uint16_t* const inner = columns_.data() + WINDOW_RADIUS;
    for (int y = -WINDOW_RADIUS; y < WINDOW_RADIUS; ++y)
    {
      changeColumns(y, 1, inner);
    }
    for (int y = 0; y < height_; ++y)
    {
      changeColumns(y + WINDOW_RADIUS, 1, inner);
      std::fill(columns_.begin(), columns_.begin() + WINDOW_RADIUS, inner[0]);
      std::fill(columns_.end() - WINDOW_RADIUS, columns_.end(), inner[width_ - 1]);
      addArmRow(scale, cost + static_cast<std::ptrdiff_t>(y) * width_,
                worst_.data() + static_cast<std::ptrdiff_t>(y) * width_);
      changeColumns(y - WINDOW_RADIUS, -1, inner);
    }
  }

  /// Adds (subtracts) a row to the sums over the window's rows; rows outside repeat the outermost.
  void changeColumns(int y, int sign, std::uint16_t* inner) const
  {
    const int inside = std::clamp(y, 0, height_ - 1);
    const std::uint16_t* const row = sums_.data() + static_cast<std::ptrdiff_t>(inside) * width_;
    for (int x = 0; x < width_; ++x)
    {
      inner[x] = static_cast<std::uint16_t>(inner[x] + sign * row[x]);
    }
  }

  void addArmRow(int scale, std::uint16_t* total, std::uint16_t* worst) const
  {
    const std::uint16_t* const sums = columns_.data();
    for (int x = 0; x < width_; ++x)
    {
      std::uint32_t window = 0;
      for (int i = 0; i < 2 * WINDOW_RADIUS + 1; ++i)
      {
        window += sums[x + i];
      }
      const auto value =
          static_cast<std::uint16_t>((window * static_cast<std::uint32_t>(scale)) >> (2 * FRACTION_BITS));
      total[x] = static_cast<std::uint16_t>(total[x] + value);
      worst[x] = std::max(worst[x], value);
    }
  }

  void dropWorst(std::uint16_t* cost) const
  {
    const auto arms = static_cast<int>(sweep_.arms.size());
    if (arms < 2)
    {
      return;
    }
    for (std::size_t i = 0; i < sums_.size(); ++i)
    {
      cost[i] = static_cast<std::uint16_t>((cost[i] - worst_[i]) / (arms - 1));
    }
  }

  const PlaneSweep& sweep_;
  int width_;
  int height_;
  std::vector<std::uint16_t> sums_;
  std::vector<std::uint16_t> columns_;
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
