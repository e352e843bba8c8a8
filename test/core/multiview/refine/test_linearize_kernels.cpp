#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "core/multiview/refine/linearize_kernels.h"
#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
class LinearizeKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, LinearizeKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

/// Views in three directions with random pixels, sampled by both versions of the kernel.
class LinearizationCase
{
public:
  static constexpr int HEIGHT = 24;
  static constexpr std::size_t TILED_STRIDE = 2 * TILE_PIXELS;

  /// @param steepness largest change of the disparity from pixel to pixel
  LinearizationCase(int channels, float steepness) : channels_(static_cast<std::size_t>(channels))
  {
    // Less than the views move: some blocks reach beyond the padding.
    constexpr int pad = 6;
    RandomRows random;
    reference_ = random.bytes(3 * ROW_STRIDE);
    disparity_ = random.floats(TILED_STRIDE, -3.0F, 3.0F);
    for (std::size_t x = 1; x < disparity_.size(); ++x)
    {
      const float before = disparity_[x - 1];
      disparity_[x] = std::clamp(disparity_[x], before - steepness, before + steepness);
    }
    const std::vector<std::array<float, 3>> placements = {{3.0F, 0.0F, 0.0F},
                                                          {-4.0F, 0.0F, 0.0F},
                                                          {0.0F, -2.0F, 0.0F},
                                                          {1.5F, -1.0F, 0.3F},
                                                          {1.0F, 1.0F, 0.0F}};
    images_.resize(placements.size());
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
      // Some views look like the reference, so that not all fall out of the mean.
      auto pixels = random.bytes(static_cast<std::size_t>(HEIGHT * ROW_WIDTH) * channels_, 40);
      preparePlanar(cv::Mat(HEIGHT, ROW_WIDTH, CV_8UC(channels), pixels.data()), {}, pad, images_[i]);
      SampledView view;
      view.pixels = images_[i].row(0);
      view.channel_stride = images_[i].channelStride();
      view.row_stride = images_[i].row(1) - images_[i].row(0);
      view.pad_before = pad;
      view.pad_after = static_cast<int>(images_[i].channelStride()) - pad - ROW_WIDTH;
      view.step_x = placements[i][0];
      view.step_y = placements[i][1];
      view.offset_x = placements[i][2];
      view.position = view.step_x - view.step_y;
      views_.push_back(view);
    }
  }

  /// The mean, followed by the moments.
  template <typename Kernel>
  std::vector<float> run(const Kernel& kernel) const
  {
    const std::vector<ViewRay> rays = {{0, 2}, {2, 3}, {3, 5}};
    std::vector<float> weights(rays.size() * TILE_PIXELS);
    std::vector<float> mean(channels_ * TILED_STRIDE);
    std::vector<float> moments(rays.size() * RAY_MOMENTS * TILED_STRIDE);
    LinearizeTile tile;
    tile.views = views_.data();
    tile.rays = rays.data();
    tile.ray_count = static_cast<int>(rays.size());
    tile.width = ROW_WIDTH;
    tile.height = HEIGHT;
    tile.channels = static_cast<int>(channels_);
    tile.reference = reference_.data();
    tile.reference_stride = ROW_STRIDE;
    tile.disparity = disparity_.data();
    tile.y = 3;
    tile.match_scale = 90.0F;
    tile.weights = weights.data();
    tile.refocused = mean.data();
    tile.refocused_stride = TILED_STRIDE;
    tile.moments = moments.data();
    tile.stride = TILED_STRIDE;
    for (tile.first = 0; tile.first < ROW_WIDTH; tile.first += TILE_PIXELS)
    {
      kernel(tile);
    }
    std::vector<float> result;
    for (const auto* rows : {&mean, &moments})
    {
      for (std::size_t row = 0; row < rows->size(); row += TILED_STRIDE)
      {
        const auto begin = rows->begin() + static_cast<std::ptrdiff_t>(row);
        result.insert(result.end(), begin, begin + ROW_WIDTH);
      }
    }
    return result;
  }

private:
  std::size_t channels_;
  std::vector<std::uint8_t> reference_;
  std::vector<float> disparity_;
  std::vector<PlanarImage> images_;
  std::vector<SampledView> views_;
};

TEST_P(LinearizeKernels, LinearizationEqualsThePlainVersion)
{
  for (const int channels : {1, 3})
  {
    for (const float steepness : {0.0F, 0.01F, 0.2F, 6.0F})
    {
      const LinearizationCase views(channels, steepness);
      const auto plain = views.run(linearizeTilePlain);
      const auto simd = views.run(linearizeTile);
      ASSERT_EQ(simd.size(), plain.size());
      for (std::size_t i = 0; i < simd.size(); ++i)
      {
        ASSERT_EQ(simd[i], plain[i]) << channels << " channels, steepness " << steepness << ", row "
                                     << i / ROW_WIDTH << " at " << i % ROW_WIDTH;
      }
    }
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
