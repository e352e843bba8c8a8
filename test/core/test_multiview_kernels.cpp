#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/light_field/pixel_kernels.h"
#include "core/light_field/view_set.h"
#include "core/multiview/refine/cubic_taps.h"
#include "core/multiview/refine/linearize_kernels.h"
#include "core/multiview/search/cost_kernels.h"
#include "core/multiview/search/label_space.h"
#include "core/multiview/search/sample_rows.h"
#include "core/multiview/search/visibility_kernels.h"
#include "support/instruction_sets.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int WIDTH = 203;  // no multiple of any vector
constexpr std::size_t STRIDE = 320;

class Random
{
public:
  std::vector<std::uint8_t> bytes(std::size_t count, int limit = 256)
  {
    std::vector<std::uint8_t> values(count);
    for (auto& value : values)
    {
      value = static_cast<std::uint8_t>(std::uniform_int_distribution<int>(0, limit - 1)(engine_));
    }
    return values;
  }
  std::vector<float> floats(std::size_t count, float low, float high)
  {
    std::vector<float> values(count);
    for (auto& value : values)
    {
      value = std::uniform_real_distribution<float>(low, high)(engine_);
    }
    return values;
  }

private:
  std::mt19937 engine_{7};
};

template <typename Values>
Values firstPart(const Values& values, std::size_t count)
{
  return Values(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

TEST(LabelSpace, CoversAnyRangeWithFewLabels)
{
  constexpr int most = 240;
  for (const float reach : {0.01F, 3.0F, 1e3F, 1e9F, 1e30F})
  {
    const LabelSpace labels = makeLabelSpace({-reach, 0.5F * reach}, 0.125F, most);
    EXPECT_GE(labels.count, 2) << reach;
    EXPECT_LE(labels.count, most) << reach;
    EXPECT_LE(labels.disparity(0.0F), -reach);
    EXPECT_GE(labels.disparity(static_cast<float>(labels.count - 1)), 0.5F * reach);
  }
}

class MultiviewKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, MultiviewKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(MultiviewKernels, WarpTargetsEqualThePlainVersion)
{
  Random random;
  const auto disparity = random.floats(WIDTH, -3.0F, 3.0F);
  for (const float step_y : {0.0F, -2.5F})
  {
    const WarpRow row{disparity.data(), WIDTH, 24, 3.0F, step_y, 0.8F, 2.5F, 256, 8};
    std::vector<std::int32_t> simd(WIDTH);
    std::vector<std::int32_t> plain(WIDTH);
    warpTargets(row, simd.data());
    warpTargetsPlain(row, plain.data());
    EXPECT_EQ(simd, plain);
    EXPECT_NE(std::count(plain.begin(), plain.end(), 0), 0);
    const auto column = static_cast<int>(std::floor(100.8F - 3.0F * disparity[100]));
    const auto line = static_cast<int>(std::floor(2.5F - step_y * disparity[100]));
    EXPECT_EQ(plain[100], line >= 0 && line < 24 ? line * 256 + column + 8 : 0);
  }
}

TEST_P(MultiviewKernels, PixelsAreSplitAsInThePlainVersion)
{
  Random random;
  const auto pixels = random.bytes(3 * WIDTH);
  std::vector<std::uint8_t> simd(3 * STRIDE, 9);
  auto plain = simd;
  splitPixels({pixels.data(), WIDTH, {simd.data(), simd.data() + STRIDE, simd.data() + 2 * STRIDE}});
  splitPixelsPlain({pixels.data(), WIDTH, {plain.data(), plain.data() + STRIDE, plain.data() + 2 * STRIDE}});
  EXPECT_EQ(simd, plain);
  EXPECT_EQ(plain[STRIDE + 100], pixels[301]);
  EXPECT_EQ(plain[STRIDE + WIDTH], 9);
}

TEST_P(MultiviewKernels, InterpolationEqualsThePlainVersion)
{
  Random random;
  const auto row = random.bytes(STRIDE);
  for (int phase = 0; phase < SUBPIXEL_PHASES; ++phase)
  {
    const std::array<const std::uint8_t*, 4> taps = {row.data(), row.data() + 1, row.data() + 2,
                                                     row.data() + 3};
    std::vector<std::uint8_t> simd(STRIDE);
    std::vector<std::uint8_t> plain(STRIDE);
    interpolateTaps(taps, phase, WIDTH, simd.data());
    interpolateTapsPlain(taps, phase, WIDTH, plain.data());
    EXPECT_EQ(firstPart(simd, WIDTH), firstPart(plain, WIDTH)) << "phase " << phase;
  }
}

TEST_P(MultiviewKernels, InterpolationKeepsARamp)
{
  std::vector<std::uint8_t> row(STRIDE);
  for (std::size_t i = 0; i < row.size(); ++i)
  {
    row[i] = static_cast<std::uint8_t>(i % 64 * 4);
  }
  std::vector<std::uint8_t> values(STRIDE);
  interpolateTaps({row.data(), row.data() + 1, row.data() + 2, row.data() + 3}, SUBPIXEL_PHASES / 4, 50,
                  values.data());
  for (std::size_t i = 0; i < 50; ++i)
  {
    EXPECT_EQ(values[i], row[i + 1] + 1) << i;  // a quarter of the slope of 4
  }
}

struct Views
{
  explicit Views(std::size_t count, Random& random) : reference(random.bytes(3 * STRIDE, 60))
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      samples.push_back(random.bytes(3 * STRIDE, 60));
      surfaces.push_back(random.bytes(STRIDE, 60));
      sample_rows.push_back(samples.back().data());
      surface_rows.push_back(surfaces.back().data());
    }
  }
  std::vector<std::uint8_t> reference;
  std::vector<std::vector<std::uint8_t>> samples;
  std::vector<std::vector<std::uint8_t>> surfaces;
  std::vector<const std::uint8_t*> sample_rows;
  std::vector<const std::uint8_t*> surface_rows;
};

TEST_P(MultiviewKernels, ArmCostEqualsThePlainVersion)
{
  struct Case
  {
    std::vector<Arm> arms;
    int best_arms;
    int channels;
  };
  const std::vector<Case> cases = {
      {{{0, 1, 0}}, 1, 3},
      {{{0, 4, 0}, {4, 8, 2}, {8, 12, 4}, {12, 16, 6}}, 2, 3},
      {{{0, 4, 0}, {4, 7, 2}, {7, 12, 4}, {12, 14, 6}}, 2, 1},
      {{{0, 1, 0}, {1, 2, 1}, {2, 3, 2}, {3, 4, 3}, {4, 5, 4}, {5, 6, 5}, {6, 7, 6}, {7, 8, 7}}, 4, 3},
  };
  for (const Case& test : cases)
  {
    Random random;
    const Views views(16, random);
    std::vector<std::uint16_t> scales;
    for (const Arm& arm : test.arms)
    {
      scales.push_back(static_cast<std::uint16_t>(240 * 256 / (30 * (arm.last - arm.first))));
    }
    ArmCostRow row;
    row.reference = views.reference.data();
    row.reference_stride = STRIDE;
    row.samples = views.sample_rows.data();
    row.sample_stride = STRIDE;
    row.channels = test.channels;
    row.width = WIDTH;
    row.arms = test.arms.data();
    row.arm_count = static_cast<int>(test.arms.size());
    row.best_arms = test.best_arms;
    row.arm_scales = scales.data();
    std::vector<std::uint8_t> simd(STRIDE);
    std::vector<std::uint8_t> plain(STRIDE);
    armCostRow(row, simd.data());
    armCostRowPlain(row, plain.data());
    EXPECT_EQ(firstPart(simd, WIDTH), firstPart(plain, WIDTH)) << test.arms.size() << " arms";
  }
}

TEST_P(MultiviewKernels, VisibleCostEqualsThePlainVersion)
{
  for (const int truncation : {20, 30, 60})
  {
    for (const int hidden_above : {0, 10, 40})
    {
      Random random;
      const Views views(16, random);
      VisibleCostRow row;
      row.reference = views.reference.data();
      row.reference_stride = STRIDE;
      row.samples = views.sample_rows.data();
      row.sample_stride = STRIDE;
      row.surfaces = views.surface_rows.data();
      row.views = 16;
      row.width = WIDTH;
      row.truncation = truncation;
      row.hidden_above = hidden_above;
      row.unseen_penalty = 20;
      std::vector<std::uint8_t> simd(STRIDE);
      std::vector<std::uint8_t> plain(STRIDE);
      visibleCostRow(row, simd.data());
      visibleCostRowPlain(row, plain.data());
      EXPECT_EQ(firstPart(simd, WIDTH), firstPart(plain, WIDTH)) << truncation << ", " << hidden_above;
    }
  }
}

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
    Random random;
    reference_ = random.bytes(3 * STRIDE);
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
      auto pixels = random.bytes(static_cast<std::size_t>(HEIGHT * WIDTH) * channels_, 40);
      preparePlanar(cv::Mat(HEIGHT, WIDTH, CV_8UC(channels), pixels.data()), {}, pad, images_[i]);
      SampledView view;
      view.pixels = images_[i].row(0);
      view.channel_stride = images_[i].channelStride();
      view.row_stride = images_[i].row(1) - images_[i].row(0);
      view.pad_before = pad;
      view.pad_after = static_cast<int>(images_[i].channelStride()) - pad - WIDTH;
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
    tile.width = WIDTH;
    tile.height = HEIGHT;
    tile.channels = static_cast<int>(channels_);
    tile.reference = reference_.data();
    tile.reference_stride = STRIDE;
    tile.disparity = disparity_.data();
    tile.y = 3;
    tile.match_scale = 90.0F;
    tile.weights = weights.data();
    tile.refocused = mean.data();
    tile.refocused_stride = TILED_STRIDE;
    tile.moments = moments.data();
    tile.stride = TILED_STRIDE;
    for (tile.first = 0; tile.first < WIDTH; tile.first += TILE_PIXELS)
    {
      kernel(tile);
    }
    std::vector<float> result;
    for (const auto* rows : {&mean, &moments})
    {
      for (std::size_t row = 0; row < rows->size(); row += TILED_STRIDE)
      {
        const auto begin = rows->begin() + static_cast<std::ptrdiff_t>(row);
        result.insert(result.end(), begin, begin + WIDTH);
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

TEST_P(MultiviewKernels, LinearizationEqualsThePlainVersion)
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
                                     << i / WIDTH << " at " << i % WIDTH;
      }
    }
  }
}

TEST(CubicTaps, InterpolateAndAddUpToOne)
{
  for (int i = 0; i < 1000; ++i)
  {
    const float t = static_cast<float>(i) / 1000.0F;
    const auto weights = cubicTaps(t);
    EXPECT_EQ(weights[0] + weights[1] + weights[2] + weights[3], TAP_MOST);
    const float exact = ((2.0F - 1.5F * t) * t + 0.5F) * t;
    EXPECT_NEAR(static_cast<float>(weights[2]) / TAP_ONE, exact, 1e-4F);
  }
  EXPECT_EQ(cubicTaps(0.0F), (std::array<int, 4>{0, TAP_MOST, 0, 0}));
}

}  // namespace
}  // namespace light_field_depth::multiview
