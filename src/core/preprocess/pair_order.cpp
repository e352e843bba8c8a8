#include "light_field_depth/core/pair_order.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/preprocess/mutual_matches.h"
#include "core/preprocess/plane_sweep.h"
#include "core/preprocess/sweep_views.h"

namespace light_field_depth
{
namespace
{
/// Of the reduced views. Set by hand: a sweep of one arm takes some milliseconds.
constexpr int MAX_SIDE_PX = 256;
/// Displacements that are looked at, in parts of the side along which the views move.
constexpr double MAX_DISPLACEMENT = 0.25;
constexpr float LABEL_STEP_PX = 0.5F;  // as in the sweeps of the range
/// Below it, the two signs are not told apart.
constexpr float MIN_DISPLACEMENT_PX = 1.0F;
/// A match without contrast is worth nothing: change of brightness from one pixel to the next but one, in
/// levels.
constexpr int MIN_CONTRAST = 6;

/// Share of the pixels with contrast that match there and back.
double mutualShare(const PlaneSweep& sweep, ThreadPool& pool)
{
  const SweepCosts volume = sweepPlanes(sweep, pool);
  const std::vector<std::uint8_t> mutual = findMutualMatches(sweep, volume, pool);
  std::size_t matched = 0;
  std::size_t all = 0;
  const cv::Mat& image = sweep.reference;
  for (int y = 1; y + 1 < image.rows; ++y)
  {
    for (int x = 1; x + 1 < image.cols; ++x)
    {
      const int across = std::abs(image.at<std::uint8_t>(y, x + 1) - image.at<std::uint8_t>(y, x - 1));
      const int down = std::abs(image.at<std::uint8_t>(y + 1, x) - image.at<std::uint8_t>(y - 1, x));
      if (std::max(across, down) >= MIN_CONTRAST)
      {
        ++all;
        matched += mutual[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.cols) +
                          static_cast<std::size_t>(x)];
      }
    }
  }
  return all > 0 ? static_cast<double>(matched) / static_cast<double>(all) : 0.0;
}

}  // namespace

PairOrder findPairOrder(const LightField& light_field, ThreadPool& pool, const PairOrderOptions& options)
{
  PairOrder order;
  if (light_field.views.size() != 2)
  {
    return order;
  }
  const LightField eight_bit = toEightBit(light_field);
  const View& other = eight_bit.views[1 - eight_bit.reference_index];
  const double distance = std::hypot(other.steps.x, other.steps.y);
  const int halvings = halvingsFor(eight_bit.size(), MAX_SIDE_PX);
  const double scale = std::pow(0.5, halvings);
  PlaneSweep sweep;
  sweep.reference = halve(toGrey(eight_bit.reference().image), halvings);
  // A disparity is a displacement in pixels here.
  sweep.arms = {{{halve(toGrey(other.image), halvings), cv::Point2f(other.steps * (1.0 / distance)),
                  cv::Point2f(other.offset_px * scale)}}};
  const bool along_rows = std::abs(other.steps.x) >= std::abs(other.steps.y);
  const auto most =
      static_cast<float>(MAX_DISPLACEMENT * (along_rows ? sweep.reference.cols : sweep.reference.rows));
  sweep.disparity_step = LABEL_STEP_PX;
  sweep.labels = static_cast<int>((most - MIN_DISPLACEMENT_PX) / LABEL_STEP_PX) + 1;
  if (!(distance > 0.0) || sweep.labels < 2)
  {
    return order;
  }
  sweep.first_disparity = MIN_DISPLACEMENT_PX;
  order.right_share = mutualShare(sweep, pool);
  sweep.first_disparity = -MIN_DISPLACEMENT_PX - static_cast<float>(sweep.labels - 1) * LABEL_STEP_PX;
  order.swapped_share = mutualShare(sweep, pool);
  const double better = std::max(order.right_share, order.swapped_share);
  const double worse = std::min(order.right_share, order.swapped_share);
  order.decided = better >= options.min_share && better >= options.min_ratio * worse;
  order.swapped = order.decided && order.swapped_share > order.right_share;
  return order;
}

}  // namespace light_field_depth
