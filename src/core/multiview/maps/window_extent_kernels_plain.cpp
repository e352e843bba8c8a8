#include <algorithm>

#include "core/multiview/maps/window_extent_kernels.h"

namespace light_field_depth::multiview
{
void findExtentsPlain(const ExtentRow& row)
{
  for (int x = 0; x < row.width; ++x)
  {
    row.low[x] = row.high[x] = row.rows[row.radius][x];
    for (int i = 0; i <= 2 * row.radius; ++i)
    {
      for (int dx = -row.radius; dx <= row.radius; ++dx)
      {
        const float value = row.rows[i][std::clamp(x + dx, 0, row.width - 1)];
        row.low[x] = std::min(row.low[x], value);
        row.high[x] = std::max(row.high[x], value);
      }
    }
  }
}

}  // namespace light_field_depth::multiview
