#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_EXPOSURE_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_EXPOSURE_KERNELS_H

#include <array>
#include <cstddef>
#include <cstdint>

namespace light_field_depth
{
/// The inner loops over the reduced views of the exposure search, each for one row of the result from the
/// rows of the image about it, with the best vector instructions that the processor has. Results do not
/// depend on these. Rows have `width` pixels of `channels` interleaved values, and at least as many pixels as
/// a window has on one side of its middle. Columns outside mirror those inside about the outermost.
template <class Element, std::size_t COUNT>
using RowsAbout = std::array<const Element*, COUNT>;

/// Words (or floats) of memory that these need for a row.
std::size_t memoryOfRow(int width, int channels);

/// The mean weighed with 1 4 6 4 1 in both directions, rounded.
void smoothRow(const RowsAbout<std::uint8_t, 5>& rows, int width, int channels, std::uint16_t* memory,
               std::uint8_t* smooth);

/// Not 0 where a value of the same channel in 3 x 3 pixels is below or above these.
void cutOffRow(const RowsAbout<std::uint8_t, 3>& rows, int width, int channels, std::uint8_t darkest,
               std::uint8_t brightest, std::uint16_t* memory, std::uint8_t* cut_off);

/// The values less their mean over 9 x 9 pixels; one channel.
void deviationRow(const RowsAbout<std::uint8_t, 9>& rows, int width, std::uint16_t* memory, float* deviation);

/// deviation * scale / (root mean square over 9 x 9 pixels + least) + middle, rounded and kept in 0..255.
struct Normalization
{
  float scale;
  float least;
  float middle;
};
void normalizeRow(const RowsAbout<float, 9>& deviations, int width, const Normalization& normalization,
                  float* memory, std::uint8_t* normalized);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_EXPOSURE_KERNELS_H
