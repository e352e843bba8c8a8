#include "core/preprocess/mutual_matches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>

#include "core/preprocess/sweep_kernels.h"

namespace light_field_depth
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 8;
/// Two labels are a pixel; displacements are rounded to whole ones here.
constexpr int MAX_LABEL_DIFFERENCE = 2;

/// For each pixel of one of the two views the label of least cost.
struct BestLabels
{
  explicit BestLabels(std::size_t area)
      : label(area, 0), cost(area, std::numeric_limits<std::uint16_t>::max())
  {
  }

  std::vector<std::uint16_t> label;
  std::vector<std::uint16_t> cost;
};

std::vector<cv::Point> shiftsOf(const PlaneSweep& sweep)
{
  const SweepView& view = sweep.arms.front().front();
  std::vector<cv::Point> shifts;
  for (int label = 0; label < sweep.labels; ++label)
  {
    const cv::Point2f shift = view.offset - sweep.disparity(static_cast<float>(label)) * view.steps;
    shifts.emplace_back(cvRound(shift.x), cvRound(shift.y));
  }
  return shifts;
}

/// Row y of a view that sees the reference's pixel p at p + shift.
void findBestInRow(const SweepCosts& volume, const std::vector<cv::Point>& shifts, int y, BestLabels& best)
{
  const cv::Size size = volume.size;
  for (std::size_t label = 0; label < shifts.size(); ++label)
  {
    const cv::Point shift = shifts[label];
    const int source_y = y - shift.y;
    const int first = std::max(0, shift.x);
    const int last = std::min(size.width, size.width + shift.x);
    if (source_y < 0 || source_y >= size.height || first >= last)
    {
      continue;
    }
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(y) * size.width + first;
    const std::ptrdiff_t source = static_cast<std::ptrdiff_t>(source_y) * size.width + first - shift.x;
    keepBest(volume.cost(static_cast<int>(label)) + source, static_cast<std::uint16_t>(label),
             static_cast<std::size_t>(last - first), best.cost.data() + row, best.label.data() + row);
  }
}

BestLabels findBest(const SweepCosts& volume, const std::vector<cv::Point>& shifts, ThreadPool& pool)
{
  BestLabels best(volume.area());
  pool.parallelFor(0, volume.size.height, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       findBestInRow(volume, shifts, y, best);
                     }
                   });
  return best;
}

}  // namespace

std::vector<std::uint8_t> findMutualMatches(const PlaneSweep& sweep, const SweepCosts& volume,
                                            ThreadPool& pool)
{
  const std::vector<cv::Point> shifts = shiftsOf(sweep);
  const BestLabels here = findBest(volume, std::vector<cv::Point>(shifts.size()), pool);
  const BestLabels there = findBest(volume, shifts, pool);
  const cv::Rect inside({}, volume.size);
  std::vector<std::uint8_t> mutual(volume.area(), 0);
  for (int y = 0; y < volume.size.height; ++y)
  {
    for (int x = 0; x < volume.size.width; ++x)
    {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(volume.size.width) +
                            static_cast<std::size_t>(x);
      const cv::Point seen = cv::Point(x, y) + shifts[here.label[i]];
      if (inside.contains(seen))
      {
        const int at_pixel = seen.y * volume.size.width + seen.x;
        const auto at = static_cast<std::size_t>(at_pixel);
        mutual[i] = std::abs(there.label[at] - here.label[i]) <= MAX_LABEL_DIFFERENCE ? 1 : 0;
      }
    }
  }
  return mutual;
}

}  // namespace light_field_depth
