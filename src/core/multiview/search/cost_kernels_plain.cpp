#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <vector>

#include "core/multiview/search/cost_kernels.h"
#include "core/multiview/search/tap_weights.h"

namespace light_field_depth::multiview
{
namespace
{
template <typename Row>
int truncatedDifference(const Row& row, const std::uint8_t* sample, int x)
{
  int sum = 0;
  for (int channel = 0; channel < row.channels; ++channel)
  {
    const auto c = static_cast<std::size_t>(channel);
    sum += std::abs(static_cast<int>(row.reference[c * row.reference_stride + static_cast<std::size_t>(x)]) -
                    static_cast<int>(sample[static_cast<std::ptrdiff_t>(c * row.sample_stride) + x]));
  }
  return std::min(sum, row.truncation);
}

int average(int a, int b)
{
  return (a + b + 1) / 2;
}

/// @param arms ascending
int meanOfBest(const std::vector<int>& arms, int best_arms)
{
  if (best_arms == 4 && arms.size() >= 4)
  {
    return average(average(arms[0], arms[1]), average(arms[2], arms[3]));
  }
  return best_arms > 1 && arms.size() > 1 ? average(arms[0], arms[1]) : arms[0];
}

bool isMasked(const RowMasks& masks, int view, int x)
{
  return masks.views[view] != nullptr && masks.views[view][x] != 0;
}

/// From the views that are not masked, each arm in proportion to those that it has left. Of half as many best
/// arms as elsewhere: an occluder and a mask together leave fewer that see the point (of the pixels beside a
/// wedge in a test scene, 0.8 instead of 1.5 % are bad).
int costOfUnmasked(const ArmCostRow& row, const RowMasks& masks, int x, std::vector<int>& arms)
{
  arms.clear();
  for (int a = 0; a < row.arm_count; ++a)
  {
    const Arm& arm = row.arms[a];
    int sum = 0;
    int seeing = 0;
    for (int view = arm.first; view < arm.last; ++view)
    {
      if (!isMasked(masks, view, x))
      {
        sum += truncatedDifference(row, row.samples[view], x);
        ++seeing;
      }
    }
    if (seeing > 0)
    {
      sum = std::min(255, sum * (arm.last - arm.first) / seeing);
      arms.push_back(std::min(255, sum * row.arm_scales[a] >> 8));
    }
  }
  if (arms.empty())
  {
    return FULL_COST;
  }
  std::sort(arms.begin(), arms.end());
  return meanOfBest(arms, std::max(1, row.best_arms / 2));
}

/// Where the reference is masked: the mean truncated difference of the views that see the point from their
/// mean. Nothing where they are too few to tell.
template <typename Row>
int costAmongViews(const Row& row, const RowMasks& masks, int x)
{
  constexpr int MIN_SEEING = 3;
  constexpr std::size_t MAX_CHANNELS = 3;
  const auto sampleAt = [&](int view, std::size_t channel) {
    return static_cast<int>(row.samples[view][static_cast<std::ptrdiff_t>(channel * row.sample_stride) + x]);
  };
  const auto channels = static_cast<std::size_t>(row.channels);
  std::array<int, MAX_CHANNELS> sums{};
  int seeing = 0;
  for (int view = 0; view < masks.view_count; ++view)
  {
    if (!isMasked(masks, view, x))
    {
      ++seeing;
      for (std::size_t c = 0; c < channels; ++c)
      {
        sums[c] += sampleAt(view, c);
      }
    }
  }
  if (seeing < MIN_SEEING)
  {
    return 0;
  }
  int cost = 0;
  for (int view = 0; view < masks.view_count; ++view)
  {
    if (!isMasked(masks, view, x))
    {
      int difference = 0;
      for (std::size_t c = 0; c < channels; ++c)
      {
        difference += std::abs(seeing * sampleAt(view, c) - sums[c]);
      }
      cost += std::min(difference / seeing, row.truncation);
    }
  }
  return cost * FULL_COST / (row.truncation * seeing);
}

}  // namespace

void interpolateTapsPlain(const std::array<const std::uint8_t*, 4>& taps, int phase, int count,
                          std::uint8_t* values)
{
  const auto& weights = TAP_WEIGHTS[static_cast<std::size_t>(phase)];
  for (int x = 0; x < count; ++x)
  {
    int sum = TAP_SCALE / 2;
    for (std::size_t tap = 0; tap < taps.size(); ++tap)
    {
      sum += weights[tap] * taps[tap][x];
    }
    values[x] = static_cast<std::uint8_t>(std::clamp(sum >> TAP_SHIFT, 0, 255));
  }
}

void armCostRowPlain(const ArmCostRow& row, std::uint8_t* cost)
{
  std::vector<int> arms(static_cast<std::size_t>(row.arm_count));
  for (int x = 0; x < row.width; ++x)
  {
    for (int a = 0; a < row.arm_count; ++a)
    {
      int sum = 0;
      for (int view = row.arms[a].first; view < row.arms[a].last; ++view)
      {
        sum = std::min(255, sum + truncatedDifference(row, row.samples[view], x));
      }
      arms[static_cast<std::size_t>(a)] = std::min(255, sum * row.arm_scales[a] >> 8);
    }
    std::sort(arms.begin(), arms.end());
    cost[x] = static_cast<std::uint8_t>(meanOfBest(arms, row.best_arms));
  }
}

void maskArmCosts(const ArmCostRow& row, const RowMasks& masks, std::uint8_t* cost)
{
  const auto width = static_cast<std::size_t>(row.width);
  std::vector<std::uint8_t> any(width, 0);
  for (int view = 0; view < masks.view_count; ++view)
  {
    if (const std::uint8_t* const masked = masks.views[view])
    {
      std::transform(any.begin(), any.end(), masked, any.begin(), std::bit_or<std::uint8_t>());
    }
  }
  std::vector<int> arms;
  for (int x = 0; x < row.width; ++x)
  {
    if (masks.reference != nullptr && masks.reference[x] != 0)
    {
      cost[x] = static_cast<std::uint8_t>(costAmongViews(row, masks, x));
    }
    else if (any[static_cast<std::size_t>(x)] != 0)
    {
      cost[x] = static_cast<std::uint8_t>(costOfUnmasked(row, masks, x, arms));
    }
  }
}

void maskVisibleCosts(const VisibleCostRow& row, const RowMasks& masks, std::uint8_t* cost)
{
  for (int x = 0; x < row.width; ++x)
  {
    if (masks.reference[x] != 0)
    {
      cost[x] = static_cast<std::uint8_t>(costAmongViews(row, masks, x));
    }
  }
}

void visibleCostRowPlain(const VisibleCostRow& row, std::uint8_t* cost)
{
  const float scale = static_cast<float>(FULL_COST) / static_cast<float>(row.truncation);
  for (int x = 0; x < row.width; ++x)
  {
    int sum = 0;
    int seeing = 0;
    for (int view = 0; view < row.views; ++view)
    {
      if (row.surfaces[view][x] <= row.hidden_above)
      {
        sum += truncatedDifference(row, row.samples[view], x);
        ++seeing;
      }
    }
    sum += std::max(0, row.min_seeing_views - seeing) * row.unseen_penalty;
    const auto count = static_cast<float>(std::max(seeing, row.min_seeing_views));
    const float mean = static_cast<float>(sum) * scale / count + 0.5F;
    cost[x] = static_cast<std::uint8_t>(std::min(static_cast<int>(mean), FULL_COST));
  }
}

}  // namespace light_field_depth::multiview
