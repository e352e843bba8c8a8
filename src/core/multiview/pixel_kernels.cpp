// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "multiview/pixel_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstddef>

#include "light_field_depth/core/multiview/pixel_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;
using Bytes = hn::CappedTag<std::uint8_t, 64>;

void splitPixelsLoop(const PixelRow& row)
{
  const Bytes bytes;
  const int lanes = static_cast<int>(hn::Lanes(bytes));
  int x = 0;
  for (; x + lanes <= row.width; x += lanes)
  {
    hn::Vec<Bytes> blue;
    hn::Vec<Bytes> green;
    hn::Vec<Bytes> red;
    hn::LoadInterleaved3(bytes, row.pixels + 3 * static_cast<std::ptrdiff_t>(x), blue, green, red);
    hn::StoreU(blue, bytes, row.planes[0] + x);
    hn::StoreU(green, bytes, row.planes[1] + x);
    hn::StoreU(red, bytes, row.planes[2] + x);
  }
  PixelRow rest = row;
  rest.pixels += 3 * static_cast<std::ptrdiff_t>(x);
  rest.width -= x;
  for (auto& plane : rest.planes)
  {
    plane += x;
  }
  splitPixelsPlain(rest);
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(splitPixelsLoop);

void splitPixels(const PixelRow& row)
{
  HWY_DYNAMIC_DISPATCH(splitPixelsLoop)(row);
}

void splitPixelsPlain(const PixelRow& row)
{
  constexpr std::size_t channels = 3;
  for (std::size_t x = 0; x < static_cast<std::size_t>(row.width); ++x)
  {
    for (std::size_t c = 0; c < channels; ++c)
    {
      row.planes[c][x] = row.pixels[channels * x + c];
    }
  }
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
