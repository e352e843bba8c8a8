#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_HALF_RESOLUTION_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_HALF_RESOLUTION_KERNELS_H

#include <cstdint>

namespace light_field_depth::multiview
{
// Shares of the channels in the brightness (ITU-R BT.601), of 4096. A sum of four pixels, shifted to 16 bits,
// times a share keeps in its upper half four bits below the brightness.
constexpr int SUM_SHIFT = 6;       // 4 * 255 has ten bits
constexpr int FRACTION_SHIFT = 4;  // 10 + 6 + 12 bits less the 16 that are dropped, less the 8 that remain
constexpr std::uint16_t BLUE_SHARE = 467;    // 0.114
constexpr std::uint16_t GREEN_SHARE = 2404;  // 0.587
constexpr std::uint16_t RED_SHARE = 1225;    // 0.299

/// One row of the reduced image from two rows of an image with `channels` (1 or 3, BGR) interleaved.
/// @param width of the reduced row. The plain version computes the same values bit for bit.
void halveRow(const std::uint8_t* upper, const std::uint8_t* lower, int channels, int width,
              std::uint8_t* half);
void halveRowPlain(const std::uint8_t* upper, const std::uint8_t* lower, int channels, int width,
                   std::uint8_t* half);

/// The same with as many channels as there are; each value is the rounded mean of four.
void halveChannelsRow(const std::uint8_t* upper, const std::uint8_t* lower, int channels, int width,
                      std::uint8_t* half);
void halveChannelsRowPlain(const std::uint8_t* upper, const std::uint8_t* lower, int channels, int width,
                           std::uint8_t* half);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_LIGHT_FIELD_HALF_RESOLUTION_KERNELS_H
