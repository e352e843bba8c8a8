#include "core/preprocess/axis_sweep.h"

#include <algorithm>
#include <cmath>

namespace light_field_depth
{
namespace
{
/// Difference at or above which nothing is learnt; that of two unrelated pixels is about 1.1.
constexpr float TRUNCATION = 1.5F;
/// Labels of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int LABELS_PER_CHUNK = 4;
constexpr float PIXEL_OF_CELL = 1.0F / (CELL_SIDE_PX * CELL_SIDE_PX);

/// A displacement split into whole pixels and a fraction, and where it stays inside.
struct Shift
{
  explicit Shift(float displacement)
      : whole(static_cast<int>(std::floor(displacement))), fraction(displacement - static_cast<float>(whole))
  {
  }
  int first() const { return std::max(0, -whole); }
  int last(int size) const { return std::max(first(), std::min(size, size - whole - 1)); }

  int whole;
  float fraction;
};

/// Adds min(|reference - blend of a and b|, TRUNCATION) for count pixels.
void addDifferences(const float* reference, const float* a, const float* b, float fraction, int count,
                    float* sum)
{
  const float rest = 1.0F - fraction;
  for (int x = 0; x < count; ++x)
  {
    sum[x] += std::min(std::abs(rest * a[x] + fraction * b[x] - reference[x]), TRUNCATION);
  }
}

/// The buffers of one label.
class LabelCosts
{
public:
  LabelCosts(const cv::Mat& reference, const std::vector<SweptView>& views, Axis axis)
      : reference_(reference), views_(views), axis_(axis), sum_(reference.size(), CV_32FC1),
        cells_(reference.rows / CELL_SIDE_PX, reference.cols / CELL_SIDE_PX, CV_32FC1),
        row_sums_(cells_.size(), CV_32FC1)
  {
  }

  void run(float displacement, float* costs)
  {
    sum_.setTo(0.0F);
    const int length = axis_ == Axis::X ? reference_.cols : reference_.rows;
    seen_.assign(static_cast<std::size_t>(length), 0.0F);
    for (const SweptView& view : views_)
    {
      const Shift shift(-displacement * view.unit);
      add(view.image, shift);
      for (int i = shift.first(); i < shift.last(length); ++i)
      {
        seen_[static_cast<std::size_t>(i)] += 1.0F;
      }
    }
    gatherCells();
    averageWindows(costs);
  }

private:
  void add(const cv::Mat& view, const Shift& shift)
  {
    const int first = axis_ == Axis::X ? 0 : shift.first();
    const int last = axis_ == Axis::X ? reference_.rows : shift.last(reference_.rows);
    for (int y = first; y < last; ++y)
    {
      if (axis_ == Axis::X)
      {
        const int x = shift.first();
        const float* const row = view.ptr<float>(y) + x + shift.whole;
        addDifferences(reference_.ptr<float>(y) + x, row, row + 1, shift.fraction,
                       shift.last(reference_.cols) - x, sum_.ptr<float>(y) + x);
      }
      else
      {
        addDifferences(reference_.ptr<float>(y), view.ptr<float>(y + shift.whole),
                       view.ptr<float>(y + shift.whole + 1), shift.fraction, reference_.cols,
                       sum_.ptr<float>(y));
      }
    }
  }

  /// Mean cost of a pixel of a cell; where no view sees it, nothing is known.
  float meanOfCell(float sum, int along) const
  {
    const float seen = seen_[static_cast<std::size_t>(along)];
    return seen > 0.0F ? PIXEL_OF_CELL * sum / seen : TRUNCATION;
  }

  void gatherCells()
  {
    for (int y = 0; y < cells_.rows; ++y)
    {
      const auto* const upper = sum_.ptr<float>(CELL_SIDE_PX * y);
      const auto* const lower = sum_.ptr<float>(CELL_SIDE_PX * y + 1);
      auto* const row = cells_.ptr<float>(y);
      for (int x = 0; x < cells_.cols; ++x)
      {
        const int left = CELL_SIDE_PX * x;
        const float sum = upper[left] + upper[left + 1] + lower[left] + lower[left + 1];
        row[x] = meanOfCell(sum, axis_ == Axis::X ? left : CELL_SIDE_PX * y);
      }
    }
  }

  /// Means over 3 x 3 cells; those at the borders are repeated.
  void averageWindows(float* costs)
  {
    constexpr float ONE_OF_NINE = 1.0F / 9.0F;  // 3 x 3 cells
    const int width = cells_.cols;
    for (int y = 0; y < cells_.rows; ++y)
    {
      const auto* const row = cells_.ptr<float>(y);
      auto* const sums = row_sums_.ptr<float>(y);
      for (int x = 1; x + 1 < width; ++x)
      {
        sums[x] = row[x - 1] + row[x] + row[x + 1];
      }
      sums[0] = 2.0F * row[0] + row[std::min(1, width - 1)];
      sums[width - 1] = row[std::max(0, width - 2)] + 2.0F * row[width - 1];
    }
    for (int y = 0; y < cells_.rows; ++y)
    {
      const auto* const upper = row_sums_.ptr<float>(std::max(0, y - 1));
      const auto* const middle = row_sums_.ptr<float>(y);
      const auto* const lower = row_sums_.ptr<float>(std::min(y + 1, cells_.rows - 1));
      for (int x = 0; x < width; ++x)
      {
        costs[y * width + x] = ONE_OF_NINE * (upper[x] + middle[x] + lower[x]);
      }
    }
  }

  const cv::Mat& reference_;
  const std::vector<SweptView>& views_;
  Axis axis_;
  cv::Mat sum_;
  cv::Mat cells_;
  cv::Mat row_sums_;
  std::vector<float> seen_;  ///< by how many views, along the axis
};

}  // namespace

cv::Mat sweepAxis(const cv::Mat& reference, const std::vector<SweptView>& views, Axis axis,
                  const Displacements& displacements, ThreadPool& pool)
{
  const int cells = (reference.rows / CELL_SIDE_PX) * (reference.cols / CELL_SIDE_PX);
  cv::Mat costs(displacements.count(), cells, CV_32FC1);
  pool.parallelFor(0, displacements.count(), LABELS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     LabelCosts label_costs(reference, views, axis);
                     for (int label = first; label < last; ++label)
                     {
                       label_costs.run(displacements.at(label), costs.ptr<float>(label));
                     }
                   });
  return costs;
}

}  // namespace light_field_depth
