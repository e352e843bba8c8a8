#include "core/preprocess/label_support.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "core/preprocess/sweep_kernels.h"

namespace light_field_depth
{
namespace
{
/// The winner takes all: per pixel the label of least cost, and the least cost at labels that are not its
/// neighbours.
struct Winners
{
  std::vector<std::uint16_t> label;
  std::vector<std::uint16_t> cost;
  std::vector<std::uint16_t> rival;
};

constexpr std::uint16_t NO_COST = std::numeric_limits<std::uint16_t>::max();
/// Pixels of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int PIXELS_PER_CHUNK = 4096;
/// Labels nearer than this to the winner belong to the same minimum; 1.5 pixels of displacement.
constexpr int RIVAL_DISTANCE = 3;

void findWinnersIn(const SweepCosts& volume, std::size_t first, std::size_t last, Winners& winners)
{
  const std::size_t count = last - first;
  for (int label = 0; label < volume.labels; ++label)
  {
    keepBest(volume.cost(label) + first, static_cast<std::uint16_t>(label), count, &winners.cost[first],
             &winners.label[first]);
  }
  for (int label = 0; label < volume.labels; ++label)
  {
    keepRival(volume.cost(label) + first, static_cast<std::uint16_t>(label), &winners.label[first],
              RIVAL_DISTANCE, count, &winners.rival[first]);
  }
}

Winners findWinners(const SweepCosts& volume, ThreadPool& pool)
{
  Winners winners;
  winners.label.assign(volume.area(), 0);
  winners.cost.assign(volume.area(), NO_COST);
  winners.rival.assign(volume.area(), NO_COST);
  pool.parallelFor(
      0, volume.size.area(), PIXELS_PER_CHUNK,
      [&](int first, int last)
      { findWinnersIn(volume, static_cast<std::size_t>(first), static_cast<std::size_t>(last), winners); });
  return winners;
}

/// A cost that a wrong disparity must exceed before the right one, of the given cost, is believed.
class Contrast
{
public:
  /// @param typical the median of the costs of the best labels, which measures noise
  explicit Contrast(std::uint16_t typical)
      : margin_(std::clamp(2 * typical, MIN_MARGIN, MAX_MARGIN) + typical / 2)
  {
  }

  bool isClear(int cost, int rival) const { return 2 * rival > 3 * cost + 2 * margin_; }

private:
  /// What rounding leaves of a perfect match.
  static constexpr int MIN_MARGIN = SWEEP_COST_PER_GREY_LEVEL * 3 / 8;
  static constexpr int MAX_MARGIN = SWEEP_COST_PER_GREY_LEVEL;

  int margin_;
};

/// The upper one of an even number. Costs take few values, which are quickly counted.
std::uint16_t median(const std::vector<std::uint16_t>& costs)
{
  std::array<std::size_t, SWEEP_TRUNCATION* SWEEP_COST_PER_GREY_LEVEL + 1> histogram = {};
  std::for_each(costs.begin(), costs.end(), [&](std::uint16_t cost) { ++histogram.at(cost); });
  std::size_t sum = histogram[0];
  std::uint16_t value = 0;
  while (sum <= costs.size() / 2)
  {
    sum += histogram[++value];
  }
  return value;
}

bool isCertain(const Winners& winners, std::size_t i, const Contrast& contrast)
{
  return winners.rival[i] != NO_COST && contrast.isClear(winners.cost[i], winners.rival[i]);
}

using Histogram = std::vector<int>;

/// How many pixels are certain of each label.
Histogram countCertain(const Winners& winners, const Contrast& contrast, int labels, ThreadPool& pool)
{
  const std::size_t chunks = (winners.label.size() + PIXELS_PER_CHUNK - 1) / PIXELS_PER_CHUNK;
  std::vector<Histogram> histograms(chunks, Histogram(static_cast<std::size_t>(labels), 0));
  pool.parallelFor(0, static_cast<int>(winners.label.size()), PIXELS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     Histogram& histogram = histograms[static_cast<std::size_t>(first / PIXELS_PER_CHUNK)];
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       histogram[winners.label[i]] += isCertain(winners, i, contrast) ? 1 : 0;
                     }
                   });
  Histogram total(static_cast<std::size_t>(labels), 0);
  for (const Histogram& histogram : histograms)
  {
    std::transform(total.begin(), total.end(), histogram.begin(), total.begin(), std::plus<>());
  }
  return total;
}

/// The labels between two quantiles of the pixels that are certain of their label.
/// @param histogram from countCertain()
std::optional<LabelRange> coreOf(const Histogram& histogram)
{
  // On either side: certain pixels are wrong now and then. What this cuts off of an object, patches add
  // again.
  constexpr double LEFT_OUT = 0.02;
  constexpr int MIN_PIXELS = 16;  // fewer are no evidence; nothing is then found
  const int total = std::accumulate(histogram.begin(), histogram.end(), 0);
  if (total < MIN_PIXELS)
  {
    return std::nullopt;
  }
  const int left_out = static_cast<int>(LEFT_OUT * total);
  LabelRange core = {0, static_cast<int>(histogram.size()) - 1};
  for (int sum = histogram[0]; sum <= left_out; sum += histogram[static_cast<std::size_t>(core.first)])
  {
    ++core.first;
  }
  for (int sum = histogram.back(); sum <= left_out; sum += histogram[static_cast<std::size_t>(core.last)])
  {
    --core.last;
  }
  return core;
}

/// Of a pixel inside a range of labels.
int leastCost(const SweepCosts& volume, const LabelRange& range, std::size_t pixel)
{
  int least = NO_COST;
  for (int label = range.first; label <= range.last; ++label)
  {
    least = std::min<int>(least, volume.cost(label)[pixel]);
  }
  return least;
}

/// Collects the pixels of a connected patch whose labels are alike from pixel to pixel.
class PatchFinder
{
public:
  /// @param member pixels that may belong to a patch; cleared as patches are taken
  PatchFinder(const Winners& winners, cv::Size size, std::vector<std::uint8_t>& member)
      : winners_(winners), size_(size), member_(member)
  {
  }

  const std::vector<int>& patchAt(int seed)
  {
    patch_.clear();
    take(seed);
    for (std::size_t next = 0; next < patch_.size(); ++next)
    {
      const int pixel = patch_[next];
      const int x = pixel % size_.width;
      visit(pixel, pixel - 1, x > 0);
      visit(pixel, pixel + 1, x + 1 < size_.width);
      visit(pixel, pixel - size_.width, pixel >= size_.width);
      visit(pixel, pixel + size_.width, pixel + size_.width < size_.area());
    }
    return patch_;
  }

private:
  void take(int pixel)
  {
    member_[static_cast<std::size_t>(pixel)] = 0;
    patch_.push_back(pixel);
  }

  void visit(int from, int to, bool inside)
  {
    if (inside && member_[static_cast<std::size_t>(to)] != 0 &&
        std::abs(winners_.label[static_cast<std::size_t>(from)] -
                 winners_.label[static_cast<std::size_t>(to)]) < RIVAL_DISTANCE)
    {
      take(to);
    }
  }

  const Winners& winners_;
  cv::Size size_;
  std::vector<std::uint8_t>& member_;
  std::vector<int> patch_;
};

/// What the pixels of a patch say together.
struct PatchEvidence
{
  int certain = 0;  ///< pixels
  double cost = 0.0;
  double rival = 0.0;
  std::vector<int> labels;  ///< in ascending order
};

PatchEvidence gatherEvidence(const std::vector<int>& patch, const Winners& winners, const Contrast& contrast)
{
  PatchEvidence evidence;
  evidence.labels.reserve(patch.size());
  for (const int pixel : patch)
  {
    const auto i = static_cast<std::size_t>(pixel);
    evidence.certain += isCertain(winners, i, contrast) ? 1 : 0;
    evidence.cost += winners.cost[i];
    evidence.rival += winners.rival[i];
    evidence.labels.push_back(winners.label[i]);
  }
  std::sort(evidence.labels.begin(), evidence.labels.end());
  return evidence;
}

/// The labels that a patch speaks for, if any: enough of its pixels are certain, or it is so large that its
/// rivals cost more on the whole, which averages the noise of single pixels away. The outermost labels are
/// left out; where single pixels are uncertain they are often wrong.
std::optional<LabelRange> labelsOf(const PatchEvidence& evidence)
{
  constexpr int MIN_CERTAIN_PX = 8;  // as of a patch
  // The mean over n pixels varies by 1 / sqrt(n) of what one does. Both numbers and those below are set by
  // hand on scenes with noise of 8 levels; with every label of a patch two views gave ranges down to -12 px
  // instead of -3.6 (docs/experiments.md).
  constexpr double MIN_RATIO = 1.1;
  constexpr double RATIO_OF_ONE_PIXEL = 7.5;
  constexpr double LEFT_OUT_OF_CERTAIN = 0.05;
  constexpr double LEFT_OUT_OF_UNCERTAIN = 0.25;
  const auto pixels = static_cast<double>(evidence.labels.size());
  const bool certain = evidence.certain >= MIN_CERTAIN_PX;
  if (!certain && evidence.rival < (MIN_RATIO + RATIO_OF_ONE_PIXEL / std::sqrt(pixels)) * evidence.cost)
  {
    return std::nullopt;
  }
  const double fraction = 2 * evidence.certain >= pixels ? LEFT_OUT_OF_CERTAIN : LEFT_OUT_OF_UNCERTAIN;
  const auto left_out = static_cast<std::size_t>(fraction * pixels);
  return LabelRange{evidence.labels[left_out], evidence.labels[evidence.labels.size() - 1 - left_out]};
}

/// Not 0 for pixels whose best label is outside the core and that are certain of it or that no label inside
/// explains.
std::vector<std::uint8_t> clearlyOutside(const LabelRange& core, const SweepCosts& volume,
                                         const Winners& winners, const Contrast& contrast, ThreadPool& pool)
{
  std::vector<std::uint8_t> outside(volume.area(), 0);
  const auto mark = [&](std::size_t i)
  {
    if ((winners.label[i] < core.first || winners.label[i] > core.last) &&
        (isCertain(winners, i, contrast) || contrast.isClear(winners.cost[i], leastCost(volume, core, i))))
    {
      outside[i] = 1;
    }
  };
  pool.parallelFor(0, volume.size.area(), PIXELS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       mark(i);
                     }
                   });
  return outside;
}

/// Widens the core by the labels of connected patches of pixels that are clearly outside it.
LabelRange widen(const LabelRange& core, const SweepCosts& volume, const Winners& winners,
                 const Contrast& contrast, ThreadPool& pool)
{
  // Of the reduced image: a third of a window of 5 x 5, within which pixels repeat each other's errors.
  constexpr std::size_t MIN_PATCH_PX = 8;
  std::vector<std::uint8_t> member = clearlyOutside(core, volume, winners, contrast, pool);
  PatchFinder finder(winners, volume.size, member);
  LabelRange supported = core;
  for (int i = 0; i < volume.size.area(); ++i)
  {
    if (member[static_cast<std::size_t>(i)] == 0)
    {
      continue;
    }
    const std::vector<int>& patch = finder.patchAt(i);
    const std::optional<LabelRange> labels =
        patch.size() < MIN_PATCH_PX ? std::nullopt : labelsOf(gatherEvidence(patch, winners, contrast));
    if (labels)
    {
      supported.first = std::min(supported.first, labels->first);
      supported.last = std::max(supported.last, labels->last);
    }
  }
  return supported;
}

/// Makes pixels that do not count uncertain of everything.
void distrust(const std::vector<std::uint8_t>& trusted, Winners& winners)
{
  for (std::size_t i = 0; i < trusted.size(); ++i)
  {
    if (trusted[i] == 0)
    {
      winners.cost[i] = NO_COST;
      winners.rival[i] = NO_COST;
    }
  }
}

/// Of the parabola through the costs of the best label and its neighbours.
float vertexOfCost(const SweepCosts& volume, int label, std::size_t pixel)
{
  if (label == 0 || label == volume.labels - 1)
  {
    return static_cast<float>(label);
  }
  const int before = volume.cost(label - 1)[pixel];
  const int here = volume.cost(label)[pixel];
  const int after = volume.cost(label + 1)[pixel];
  const int curvature = before - 2 * here + after;
  const float shift =
      curvature > 0 ? 0.5F * static_cast<float>(before - after) / static_cast<float>(curvature) : 0.0F;
  return static_cast<float>(label) + shift;
}

}  // namespace

std::vector<float> findLikelyLabels(const SweepCosts& volume, ThreadPool& pool,
                                    const std::vector<std::uint8_t>& trusted)
{
  Winners winners = findWinners(volume, pool);
  distrust(trusted, winners);
  constexpr std::uint16_t SLIGHT_NOISE = SWEEP_COST_PER_GREY_LEVEL;
  const Contrast contrast(SLIGHT_NOISE);
  std::vector<float> labels(volume.area(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (isCertain(winners, i, contrast))
    {
      labels[i] = vertexOfCost(volume, winners.label[i], i);
    }
  }
  return labels;
}

std::optional<LabelSupport> findSupportedLabels(const SweepCosts& volume, ThreadPool& pool,
                                                const std::vector<std::uint8_t>& trusted)
{
  Winners winners = findWinners(volume, pool);
  const Contrast contrast(median(winners.cost));
  distrust(trusted, winners);
  const std::optional<LabelRange> core = coreOf(countCertain(winners, contrast, volume.labels, pool));
  if (!core)
  {
    return std::nullopt;
  }
  return LabelSupport{*core, widen(*core, volume, winners, contrast, pool)};
}

}  // namespace light_field_depth
