#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_LINEARIZE_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_LINEARIZE_KERNELS_H

#include <cstddef>
#include <cstdint>

namespace light_field_depth::multiview
{
/// Pixels of a row that are worked on at a time, a multiple of every vector.
constexpr int TILE_PIXELS = 128;

/// What is summed over the views of a ray, a row of numbers each. r is the difference of a view to the
/// refocused mean, k its position along the ray, and every product is weighted with 1 / (e + 2), where e is
/// the view's difference to the reference, sum of three channels. KR has one row a channel.
constexpr std::size_t RAY_RESIDUAL = 0;  ///< sum e, without weight
constexpr std::size_t RAY_KK = 1;        ///< sum k k
constexpr std::size_t RAY_KR = 2;        ///< sum k r
constexpr std::size_t RAY_MOMENTS = 5;   ///< with three channels

/// Added to the residual of a view before its weight is taken, 1 / (residual + this).
constexpr float RESIDUAL_SOFTENING = 2.0F;

/// A view to take samples of. Its channels lie in planes.
struct SampledView
{
  const std::uint8_t* pixels = nullptr;  ///< pixel (0, 0) of the first channel
  std::size_t channel_stride = 0;        ///< bytes from one channel of a row to the next
  std::ptrdiff_t row_stride = 0;         ///< bytes from row to row
  int pad_before = 0;                    ///< pixels before each row that repeat its first
  int pad_after = 0;                     ///< after each row, likewise; at least VECTOR_ROOM
  float step_x = 0.0F;  ///< pixel (x, y) is seen at x + offset_x - disparity * step_x, likewise y
  float step_y = 0.0F;
  float offset_x = 0.0F;
  float offset_y = 0.0F;
  float position = 0.0F;                 ///< k
  const std::uint8_t* masked = nullptr;  ///< pixel (0, 0): not 0 where it takes no part; nullptr: nowhere
  std::ptrdiff_t masked_stride = 0;      ///< bytes from row to row
};

/// Pixels that a vector may read past the end of a row.
constexpr int VECTOR_ROOM = 32;

/// Views that stand on one ray from the reference, as a range of views.
struct ViewRay
{
  int first = 0;
  int last = 0;  ///< one past the last
};

/// Up to TILE_PIXELS pixels of one row of the reference with all views.
struct LinearizeTile
{
  const SampledView* views = nullptr;
  const ViewRay* rays = nullptr;  ///< together all views, in their order
  int ray_count = 0;
  int width = 0;  ///< of every view
  int height = 0;
  int channels = 3;
  const std::uint8_t* reference = nullptr;  ///< pixel 0 of the reference's row, VECTOR_ROOM after its end
  std::size_t reference_stride = 0;
  const std::uint8_t* reference_masked = nullptr;  ///< of its row; nullptr: nothing is masked
  /// Of the reference's row, readable up to `stride`. No pixel is seen 16000 pixels away.
  const float* disparity = nullptr;
  int first = 0;  ///< pixels first .. first + TILE_PIXELS - 1 of the row y
  int y = 0;
  float match_scale = 12.0F;   ///< differences to the reference above this lose their share of the mean
  float* weights = nullptr;    ///< scratch, [ray_count][TILE_PIXELS]
  float* refocused = nullptr;  ///< [channels][refocused_stride], of the row: mean of the views that agree
  std::size_t refocused_stride = 0;
  float* moments = nullptr;  ///< [ray_count][RAY_MOMENTS][stride], of the row
  std::size_t stride = 0;    ///< at least the width, a multiple of TILE_PIXELS; the end is undefined
};

/// Samples every view where it sees the reference's pixels, averages the views that agree with the reference,
/// and sums the moments of each ray. The plain version computes the same values bit for bit.
void linearizeTile(const LinearizeTile& tile);
void linearizeTilePlain(const LinearizeTile& tile);

/// Computes anew the pixels of which a view is masked: from the others. A ray that is masked as a whole adds
/// nothing and fits badly. Where the reference is masked, all views are.
void linearizeMaskedPixels(const LinearizeTile& tile);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_LINEARIZE_KERNELS_H
