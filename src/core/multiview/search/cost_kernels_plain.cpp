#include <algorithm>
#include <array>
#include <cstdlib>
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
    int mean = arms[0];
    if (row.best_arms == 2)
    {
      mean = average(arms[0], arms[1]);
    }
    else if (row.best_arms == 4)
    {
      mean = average(average(arms[0], arms[1]), average(arms[2], arms[3]));
    }
    cost[x] = static_cast<std::uint8_t>(mean);
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
