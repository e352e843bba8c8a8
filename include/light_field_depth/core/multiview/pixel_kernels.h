#ifndef LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_KERNELS_H
#define LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_KERNELS_H

#include <array>
#include <cstdint>

namespace light_field_depth::multiview
{
/// A row of pixels of three channels and where it goes.
struct PixelRow
{
  const std::uint8_t* pixels = nullptr;  ///< [width][3]
  int width = 0;
  std::array<std::uint8_t*, 3> planes{};  ///< [width] each, result
};

/// The plain version computes the same values.
void splitPixels(const PixelRow& row);
void splitPixelsPlain(const PixelRow& row);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_PIXEL_KERNELS_H
