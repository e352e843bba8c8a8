#include <cstddef>

#include "core/light_field/pixel_kernels.h"

namespace light_field_depth::multiview
{
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

void colourChangesPlain(const ColourChangeRow& row, std::uint16_t* from_left, std::uint16_t* from_above)
{
  const auto change = [&](const std::uint8_t* a, const std::uint8_t* b)
  { return static_cast<std::uint16_t>(colourDifference(a, b, row.channel_stride, row.channels)); };
  for (int x = 0; x < row.width; ++x)
  {
    from_left[x] = change(row.pixels + x - 1, row.pixels + x);
    from_above[x] = change(row.above + x, row.pixels + x);
  }
}

}  // namespace light_field_depth::multiview
