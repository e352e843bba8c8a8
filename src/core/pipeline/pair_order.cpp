#include "light_field_depth/core/pair_order.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/multiview/multiview_estimator.h"
#include "core/preprocess/sweep_views.h"

namespace light_field_depth
{
namespace
{
/// Of the reduced views. With 512, pairs that are focused on a plane look more one-sided (dolls: 2.2 instead
/// of 1.2), and it takes three times as long.
constexpr int MAX_SIDE_PX = 256;
constexpr int MIN_SIDE_PX = 16;  // what makeLightField() takes
/// Displacements that are looked at, in parts of the side along which the views move.
constexpr double MAX_DISPLACEMENT = 0.25;
/// Below it, the two orders are not told apart. In pixels of the reduced views.
constexpr float MIN_DISPLACEMENT_PX = 1.0F;

cv::Mat reducedGrey(const cv::Mat& image, int halvings)
{
  return halve(toGrey(image), halvings);
}

/// The pair with disparities in pixels.
struct ReducedPair
{
  View reference;
  View other;
  DisparityRange range;
};

ReducedPair reduce(const LightField& light_field)
{
  const LightField bytes = toEightBit(light_field);
  const cv::Size size = bytes.size();
  int halvings = halvingsFor(size, MAX_SIDE_PX);
  while (halvings > 0 && (std::min(size.width, size.height) >> halvings) < MIN_SIDE_PX)
  {
    --halvings;
  }
  ReducedPair pair;
  pair.reference.image = reducedGrey(bytes.reference().image, halvings);
  const View& other = bytes.views[1 - bytes.reference_index];
  pair.other.image = reducedGrey(other.image, halvings);
  pair.other.steps = other.steps * (1.0 / std::hypot(other.steps.x, other.steps.y));
  pair.other.offset_px = other.offset_px * std::pow(0.5, halvings);
  const cv::Size reduced = pair.reference.image.size();
  const bool along_rows = std::abs(other.steps.x) >= std::abs(other.steps.y);
  pair.range = {MIN_DISPLACEMENT_PX,
                static_cast<float>(MAX_DISPLACEMENT * (along_rows ? reduced.width : reduced.height))};
  return pair;
}

/// Share of the pixels that a map of each view confirms in the other, if the second view stands on this side.
double confirmedShare(const ReducedPair& pair, double side, ThreadPool& pool)
{
  View other = pair.other;
  other.steps *= side;
  other.grid = {static_cast<int>(std::lround(other.steps.y)), static_cast<int>(std::lround(other.steps.x))};
  const LightField light_field = makeLightField({pair.reference, other}, pair.reference.grid);
  MultiviewOptions options;
  options.preset = MultiviewPreset::Fast;
  MultiviewEstimator estimator(options);
  EstimateRequest request;
  request.disparity_range = pair.range;
  RunContext context(pool);
  const cv::Mat filled = estimator.estimate(light_field, request, context).filled;
  return filled.empty()
             ? 1.0
             : 1.0 - static_cast<double>(cv::countNonZero(filled)) / static_cast<double>(filled.total());
}

}  // namespace

PairOrder findPairOrder(const LightField& light_field, ThreadPool& pool, const PairOrderOptions& options)
{
  PairOrder order;
  if (light_field.views.size() != 2)
  {
    return order;
  }
  const ReducedPair pair = reduce(light_field);
  if (!(pair.range.max >= 2.0F * MIN_DISPLACEMENT_PX))
  {
    return order;
  }
  order.right_share = confirmedShare(pair, 1.0, pool);
  order.swapped_share = confirmedShare(pair, -1.0, pool);
  const double better = std::max(order.right_share, order.swapped_share);
  const double worse = std::min(order.right_share, order.swapped_share);
  order.decided = better >= options.min_share && better >= options.min_ratio * worse;
  order.swapped = order.decided && order.swapped_share > order.right_share;
  return order;
}

}  // namespace light_field_depth
