#include <algorithm>

#include "light_field_depth/core/multiview/path_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// One pixel of one path. @return the minimum over the labels
std::uint16_t pathStep(const std::uint8_t* cost, const std::uint16_t* before, int before_minimum, int p1,
                       int p2, int pitch, std::uint16_t* after)
{
  int minimum = STATE_GUARD_VALUE;
  for (int label = 0; label < pitch; ++label)
  {
    const int neighbour = std::min<int>(before[label - 1], before[label + 1]) + p1;
    const int best = std::min({static_cast<int>(before[label]), neighbour, before_minimum + p2});
    const int value = cost[label] + best - before_minimum;
    after[label] = static_cast<std::uint16_t>(value);
    minimum = std::min(minimum, value);
  }
  return static_cast<std::uint16_t>(minimum);
}

std::uint16_t firstStep(const std::uint8_t* cost, int pitch, std::uint16_t* after)
{
  std::copy(cost, cost + pitch, after);
  return *std::min_element(cost, cost + pitch);
}

}  // namespace

void aggregateRowPlain(const PathRow& row, std::uint16_t* states)
{
  const auto pitch = static_cast<std::size_t>(row.pitch);
  const std::size_t state_stride = pitch + 2 * STATE_GUARD;
  std::fill(row.sums, row.sums + static_cast<std::size_t>(row.width) * pitch, std::uint16_t{0});
  for (const bool backward : {false, true})
  {
    std::uint16_t* before = states + STATE_GUARD;
    std::uint16_t* after = before + state_stride;
    std::uint16_t minimum = 0;
    for (int i = 0; i < row.width; ++i)
    {
      const int x = backward ? row.width - 1 - i : i;
      const std::size_t offset = static_cast<std::size_t>(x) * pitch;
      const int p2 = i == 0 ? 0 : row.p2[backward ? x + 1 : x];
      minimum = i == 0 ? firstStep(row.cost + offset, row.pitch, after)
                       : pathStep(row.cost + offset, before, minimum, row.p1, p2, row.pitch, after);
      for (std::size_t label = 0; label < pitch; ++label)
      {
        row.sums[offset + label] = static_cast<std::uint16_t>(row.sums[offset + label] + after[label]);
      }
      std::swap(before, after);
    }
  }
}

void aggregateStepPlain(const PathRow& row, bool first, const std::uint16_t* before, std::uint16_t* after,
                        std::uint16_t* minima)
{
  const auto pitch = static_cast<std::size_t>(row.pitch);
  const std::size_t state_stride = pitch + 2 * STATE_GUARD;
  for (int x = 0; x < row.width; ++x)
  {
    const std::size_t offset = static_cast<std::size_t>(x) * pitch;
    const std::size_t state = static_cast<std::size_t>(x) * state_stride + STATE_GUARD;
    minima[x] = first ? firstStep(row.cost + offset, row.pitch, after + state)
                      : pathStep(row.cost + offset, before + state, minima[x], row.p1, row.p2[x], row.pitch,
                                 after + state);
    for (std::size_t label = 0; label < pitch; ++label)
    {
      row.sums[offset + label] = static_cast<std::uint16_t>(row.sums[offset + label] + after[state + label]);
    }
  }
}

void selectLabelsPlain(const std::uint16_t* sums, int width, int labels, int pitch, float* best)
{
  for (int x = 0; x < width; ++x)
  {
    const std::uint16_t* const pixel = sums + static_cast<std::size_t>(x) * static_cast<std::size_t>(pitch);
    const auto label = static_cast<int>(std::min_element(pixel, pixel + labels) - pixel);
    float shift = 0.0F;
    if (label > 0 && label + 1 < labels)
    {
      const int below = pixel[label - 1] - pixel[label];
      const int above = pixel[label + 1] - pixel[label];
      const int steeper = std::max(below, above);
      shift = steeper > 0 ? 0.5F * static_cast<float>(below - above) / static_cast<float>(steeper) : 0.0F;
    }
    best[x] = static_cast<float>(label) + shift;
  }
}

}  // namespace light_field_depth::multiview
