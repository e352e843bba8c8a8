#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_PIXEL_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_PIXEL_KERNELS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace light_field_depth::multiview
{
/// Sum of the absolute differences of two pixels over their channels, one plane apart; a grey one counts
/// three times.
inline int colourDifference(const std::uint8_t* a, const std::uint8_t* b, std::size_t channel_stride,
                            int channels)
{
  int sum = 0;
  for (int channel = 0; channel < channels; ++channel)
  {
    const std::size_t offset = static_cast<std::size_t>(channel) * channel_stride;
    sum += std::abs(static_cast<int>(a[offset]) - static_cast<int>(b[offset]));
  }
  return channels == 1 ? 3 * sum : sum;
}

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

/// The changes of colour of a row from the pixels beside and above it.
struct ColourChangeRow
{
  const std::uint8_t* pixels = nullptr;  ///< readable one pixel before its beginning
  const std::uint8_t* above = nullptr;   ///< the row above, the same row in the first one
  std::size_t channel_stride = 0;
  int channels = 3;  ///< 3, or 1 that counts three times
  int width = 0;
};

/// colourDifference() of each, [width].
void colourChanges(const ColourChangeRow& row, std::uint16_t* from_left, std::uint16_t* from_above);
void colourChangesPlain(const ColourChangeRow& row, std::uint16_t* from_left, std::uint16_t* from_above);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_PIXEL_KERNELS_H
