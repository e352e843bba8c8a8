// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/maps/window_extent_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "core/base/pixel_loops-inl.h"
#include "core/multiview/maps/window_extent_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

void findExtentsSimd(const ExtentRow& row)
{
  const int size = 2 * row.radius + 1;
  float* const low = row.columns + ExtentRow::MAX_RADIUS;
  float* const high = low + row.width + 2 * ExtentRow::MAX_RADIUS;
  forPixels(0, row.width,
            [&](auto f, int x)
            {
              auto least = hn::LoadU(f, row.rows[0] + x);
              auto most = least;
              for (int i = 1; i < size; ++i)
              {
                const auto value = hn::LoadU(f, row.rows[i] + x);
                least = hn::Min(least, value);
                most = hn::Max(most, value);
              }
              hn::StoreU(least, f, low + x);
              hn::StoreU(most, f, high + x);
            });
  for (float* const columns : {low, high})
  {
    for (int dx = 1; dx <= row.radius; ++dx)
    {
      columns[-dx] = columns[0];
      columns[row.width - 1 + dx] = columns[row.width - 1];
    }
  }
  forPixels(0, row.width,
            [&](auto f, int x)
            {
              auto least = hn::LoadU(f, low + x - row.radius);
              auto most = hn::LoadU(f, high + x - row.radius);
              for (int dx = 1 - row.radius; dx <= row.radius; ++dx)
              {
                least = hn::Min(least, hn::LoadU(f, low + x + dx));
                most = hn::Max(most, hn::LoadU(f, high + x + dx));
              }
              hn::StoreU(least, f, row.low + x);
              hn::StoreU(most, f, row.high + x);
            });
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(findExtentsSimd);

ExtentRow extentRowOf(const cv::Mat& map, int y, int radius)
{
  ExtentRow row;
  row.radius = radius;
  row.width = map.cols;
  for (int dy = -radius; dy <= radius; ++dy)
  {
    row.rows[dy + radius] = map.ptr<float>(std::clamp(y + dy, 0, map.rows - 1));
  }
  return row;
}

void findExtents(const ExtentRow& row)
{
  HWY_DYNAMIC_DISPATCH(findExtentsSimd)(row);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
