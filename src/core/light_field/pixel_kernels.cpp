// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/light_field/pixel_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstddef>

#include "core/light_field/pixel_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;
using Bytes = hn::CappedTag<std::uint8_t, 64>;

void splitPixelsSimd(const PixelRow& row)
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

HWY_INLINE int changeOf(int a, int b)
{
  return a < b ? b - a : a - b;
}

void colourChangesSimd(const ColourChangeRow& row, std::uint16_t* HWY_RESTRICT from_left,
                       std::uint16_t* HWY_RESTRICT from_above)
{
  const std::size_t second = row.channels == 1 ? 0 : row.channel_stride;
  const std::uint8_t* HWY_RESTRICT here = row.pixels;
  const std::uint8_t* HWY_RESTRICT above = row.above;
  const int width = row.width;
  for (int x = 0; x < width; ++x)
  {
    const std::uint8_t* const one = here + x;
    const std::uint8_t* const two = one + second;
    const std::uint8_t* const three = two + second;
    from_left[x] = static_cast<std::uint16_t>(changeOf(one[0], one[-1]) + changeOf(two[0], two[-1]) +
                                              changeOf(three[0], three[-1]));
  }
  for (int x = 0; x < width; ++x)
  {
    const std::uint8_t* const one = here + x;
    const std::uint8_t* const other = above + x;
    from_above[x] =
        static_cast<std::uint16_t>(changeOf(one[0], other[0]) + changeOf(one[second], other[second]) +
                                   changeOf(one[2 * second], other[2 * second]));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(splitPixelsSimd);
HWY_EXPORT(colourChangesSimd);

void splitPixels(const PixelRow& row)
{
  HWY_DYNAMIC_DISPATCH(splitPixelsSimd)(row);
}

void colourChanges(const ColourChangeRow& row, std::uint16_t* from_left, std::uint16_t* from_above)
{
  HWY_DYNAMIC_DISPATCH(colourChangesSimd)(row, from_left, from_above);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
