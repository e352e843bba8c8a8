#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/multiview/refine/linearize_kernels.h"
#include "core/multiview/refine/normal_equation_kernels.h"
#include "support/instruction_sets.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int WIDTH = 203;  // no multiple of any vector
constexpr std::size_t STRIDE = 256;
constexpr std::size_t CHANNELS = 3;

std::vector<float> randomRows(std::size_t rows, float low, float high)
{
  static std::mt19937 engine(11);
  std::uniform_real_distribution<float> distribution(low, high);
  std::vector<float> values(rows * STRIDE);
  std::generate(values.begin(), values.end(), [&] { return distribution(engine); });
  return values;
}

class NormalEquations : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, NormalEquations, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(NormalEquations, RowsAndWindowsAreSummedInOrder)
{
  const auto values = randomRows(3, -100.0F, 100.0F);
  const std::vector<const float*> rows = {values.data(), values.data() + STRIDE, values.data() + 2 * STRIDE};
  std::vector<float> sums(STRIDE);
  sumRows(rows.data(), 3, WIDTH, sums.data());
  for (std::size_t x = 0; x < WIDTH; ++x)
  {
    ASSERT_EQ(sums[x], rows[0][x] + rows[1][x] + rows[2][x]) << x;
  }
  for (const int radius : {0, 2, 4})
  {
    std::vector<float> box(STRIDE);
    boxRow(sums.data(), WIDTH, radius, box.data());
    for (int x = 0; x < WIDTH; ++x)
    {
      float expected = 0.0F;
      for (int dx = -radius; dx <= radius; ++dx)
      {
        expected += sums[static_cast<std::size_t>(std::clamp(x + dx, 0, WIDTH - 1))];
      }
      ASSERT_EQ(box[static_cast<std::size_t>(x)], expected) << "radius " << radius << " at " << x;
    }
  }
}

TEST_P(NormalEquations, AWindowWiderThanTheRowRepeatsItsEnds)
{
  const std::vector<float> row = {1.0F, 2.0F, 4.0F};
  std::vector<float> box(3);
  boxRow(row.data(), 3, 4, box.data());
  EXPECT_EQ(box, (std::vector<float>{1 * 5 + 2 + 4 * 3, 1 * 4 + 2 + 4 * 4, 1 * 3 + 2 + 4 * 5}));
}

TEST_P(NormalEquations, DifferencesOfFourPixelsAreExactOnACubic)
{
  const auto cubic = [](double t) { return 0.5 * t * t * t - t * t + 3.0 * t; };
  const auto slope = [](double t) { return 1.5 * t * t - 2.0 * t + 3.0; };
  constexpr int width = 9;
  std::vector<std::vector<float>> rows(5, std::vector<float>(width + 4));
  DerivativeRow row;
  for (std::size_t y = 0; y < rows.size(); ++y)
  {
    for (std::size_t x = 0; x < rows[y].size(); ++x)
    {
      rows[y][x] = static_cast<float>(cubic(static_cast<double>(x) - 4.0) + cubic(static_cast<double>(y)));
    }
    row.rows[y] = rows[y].data() + 2;
  }
  std::vector<float> along_x(width);
  std::vector<float> along_y(width);
  row.width = width;
  row.along_x = along_x.data();
  row.along_y = along_y.data();
  differentiate(row);
  for (int x = 0; x < width; ++x)
  {
    EXPECT_NEAR(along_x[static_cast<std::size_t>(x)], slope(x - 2.0), 1e-3);
    EXPECT_NEAR(along_y[static_cast<std::size_t>(x)], slope(2.0), 1e-3);
  }
}

/// Views of brightness offset + slope of each channel * k, whose points have moved by `step` px of disparity:
/// what the moments say, and the step that the equations give back.
TEST_P(NormalEquations, FindTheStepUnderABrightnessThatChangesWithThePosition)
{
  constexpr float step = 0.05F;
  const std::vector<float> positions = {-2.0F, -1.0F, 1.0F, 2.0F};
  const auto gradients = randomRows(CHANNELS, 2.0F, 20.0F);
  const std::vector<float> none(CHANNELS * STRIDE);
  const std::vector<float> share(STRIDE, 1.0F);
  const std::vector<float> brightness_slope = {1.5F, -2.0F, 0.7F};
  std::vector<float> moments(RAY_MOMENTS * STRIDE);
  for (const float k : positions)
  {
    for (std::size_t x = 0; x < WIDTH; ++x)
    {
      moments[RAY_KK * STRIDE + x] += k * k;
      for (std::size_t c = 0; c < CHANNELS; ++c)
      {
        const float r = k * (gradients[c * STRIDE + x] * step + brightness_slope[c]);
        moments[(RAY_KR + c) * STRIDE + x] += k * r;
      }
    }
  }
  std::vector<float> pair(momentCount(CHANNELS) * STRIDE);
  RayRow ray;
  ray.moments = moments.data();
  ray.share = share.data();
  ray.along_x = gradients.data();
  ray.along_y = none.data();
  ray.direction_x = 1.0F;
  ray.width = WIDTH;
  ray.stride = STRIDE;
  addRay(ray, pair.data());
  // Two columns of different gradient share one step; the slope of the brightness is theirs alone to explain.
  std::vector<float> window(momentCount(CHANNELS) * STRIDE);
  for (std::size_t moment = 0; moment < momentCount(CHANNELS); ++moment)
  {
    boxRow(pair.data() + moment * STRIDE, WIDTH, 1, window.data() + moment * STRIDE);
  }
  std::vector<float> sums(4 * STRIDE);
  const SolutionRow solution{sums.data(), sums.data() + STRIDE, sums.data() + 2 * STRIDE,
                             sums.data() + 3 * STRIDE};
  PairRow row;
  row.moments = window.data();
  row.width = WIDTH;
  row.stride = STRIDE;
  addPair(row, solution);
  const std::vector<float> disparity(STRIDE, 1.0F);
  FinalRow final_row;
  final_row.disparity = disparity.data();
  final_row.window = 3.0F;
  const std::vector<float> slope_noise(STRIDE, 0.5F);
  final_row.slope_noise = slope_noise.data();
  final_row.width = WIDTH;
  solveRow(final_row, solution);
  for (std::size_t x = 1; x + 1 < WIDTH; ++x)
  {
    ASSERT_NEAR(solution.gradient[x], 1.0F + step, 2e-3) << x;
    ASSERT_LE(solution.disagreement[x], 1e-3) << x;
    ASSERT_GT(solution.curvature[x], 0.0F) << x;
    // Three columns of four views with k^2 = 4, 1, 1, 4 in a window of three.
    ASSERT_NEAR(solution.positions[x], 0.5F * 10.0F, 1e-4) << x;
  }
}

TEST_P(NormalEquations, TheBestArmHasTheWholeShare)
{
  std::vector<float> lowest(STRIDE, 100.0F);
  auto good = randomRows(1, 1.0F, 2.0F);
  auto bad = randomRows(1, 3.0F, 9.0F);
  const auto bad_before = bad;
  scaleAndLower(1.0F, 0.0F, WIDTH, good.data(), lowest.data());
  scaleAndLower(2.0F, 1.0F, WIDTH, bad.data(), lowest.data());
  const auto best = good;
  shareOfArm(lowest.data(), WIDTH, good.data());
  shareOfArm(lowest.data(), WIDTH, bad.data());
  for (std::size_t x = 0; x < WIDTH; ++x)
  {
    EXPECT_EQ(good[x], 1.0F);
    EXPECT_NEAR(bad[x], std::pow(best[x] / (2.0F * bad_before[x] + 1.0F), 4.0F), 1e-6);
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
