#ifndef LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_LINEARIZE_KERNELS_H
#define LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_LINEARIZE_KERNELS_H

#include <cstddef>
#include <cstdint>

namespace light_field_depth::multiview
{
/// What is summed over the views, a row of numbers each. g is the derivative of a
/// view's brightness by the disparity, r its difference to the reference, k its position along its arm, and
/// every product is weighted with 1 / (sum |r| + 2). KG and KR have one row a channel.
constexpr std::size_t MOMENT_RESIDUAL = 0;  ///< sum |r|, without weight
constexpr std::size_t MOMENT_GG = 1;
constexpr std::size_t MOMENT_GR = 2;
constexpr std::size_t MOMENT_KK = 3;
constexpr std::size_t MOMENT_KG = 4;
constexpr std::size_t MOMENT_KR = 7;
constexpr std::size_t MOMENTS = 10;

/// One view at one row of the reference.
struct LinearizeRow
{
  const std::uint8_t* pixels = nullptr;  ///< of the view: channels and, for colour, an unused byte
  int pixel_stride = 4;                  ///< bytes from pixel to pixel; with 1, three bytes follow the last
  int row_stride = 0;                    ///< bytes from row to row
  int width = 0;
  int height = 0;
  int channels = 3;
  const std::uint8_t* reference = nullptr;  ///< pixel 0 of the reference's row, channels one plane apart
  std::size_t reference_stride = 0;
  const float* disparity = nullptr;  ///< [width], readable up to moment_stride
  int y = 0;
  float step_x = 0.0F;  ///< pixel (x, y) is seen at x + offset_x - disparity * step_x, likewise y
  float step_y = 0.0F;
  float offset_x = 0.0F;
  float offset_y = 0.0F;
  float position = 0.0F;     ///< k
  float* moments = nullptr;  ///< [MOMENTS][moment_stride], added to; what lies past the width is undefined
  std::size_t moment_stride = 0;  ///< at least the width, a multiple of MOMENT_MULTIPLE
};

constexpr int MOMENT_MULTIPLE = 16;

/// Samples the view where it sees the reference's row and adds its moments. The plain version computes the
/// same values bit for bit.
void linearizeRow(const LinearizeRow& row);
void linearizeRowPlain(const LinearizeRow& row);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_LINEARIZE_KERNELS_H
