#include <algorithm>
#include <array>

#include "core/multiview/search/median_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int RADIUS = MEDIAN_SIZE / 2;
constexpr std::size_t MIDDLE = MEDIAN_SIZE * MEDIAN_SIZE / 2;

}  // namespace

void medianRowPlain(const MedianRow& row)
{
  for (int x = 0; x < row.width; ++x)
  {
    std::array<float, MEDIAN_SIZE * MEDIAN_SIZE> window{};
    auto* next = window.begin();
    for (const float* const values : row.rows)
    {
      for (int dx = -RADIUS; dx <= RADIUS; ++dx)
      {
        *next++ = values[std::clamp(x + dx, 0, row.width - 1)];
      }
    }
    std::nth_element(window.begin(), window.begin() + MIDDLE, window.end());
    row.medians[x] = window[MIDDLE] * row.scale + row.offset;
  }
}

}  // namespace light_field_depth::multiview
