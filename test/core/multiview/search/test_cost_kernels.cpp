#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/light_field/view_set.h"
#include "core/multiview/search/cost_kernels.h"
#include "core/multiview/search/sample_rows.h"
#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
class CostKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, CostKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(CostKernels, InterpolationEqualsThePlainVersion)
{
  RandomRows random;
  const auto row = random.bytes(ROW_STRIDE);
  for (int phase = 0; phase < SUBPIXEL_PHASES; ++phase)
  {
    const std::array<const std::uint8_t*, 4> taps = {row.data(), row.data() + 1, row.data() + 2,
                                                     row.data() + 3};
    std::vector<std::uint8_t> simd(ROW_STRIDE);
    std::vector<std::uint8_t> plain(ROW_STRIDE);
    interpolateTaps(taps, phase, ROW_WIDTH, simd.data());
    interpolateTapsPlain(taps, phase, ROW_WIDTH, plain.data());
    EXPECT_EQ(firstPart(simd, ROW_WIDTH), firstPart(plain, ROW_WIDTH)) << "phase " << phase;
  }
}

TEST_P(CostKernels, InterpolationKeepsARamp)
{
  std::vector<std::uint8_t> row(ROW_STRIDE);
  for (std::size_t i = 0; i < row.size(); ++i)
  {
    row[i] = static_cast<std::uint8_t>(i % 64 * 4);
  }
  std::vector<std::uint8_t> values(ROW_STRIDE);
  interpolateTaps({row.data(), row.data() + 1, row.data() + 2, row.data() + 3}, SUBPIXEL_PHASES / 4, 50,
                  values.data());
  for (std::size_t i = 0; i < 50; ++i)
  {
    EXPECT_EQ(values[i], row[i + 1] + 1) << i;  // a quarter of the slope of 4
  }
}

struct Views
{
  explicit Views(std::size_t count, RandomRows& random) : reference(random.bytes(3 * ROW_STRIDE, 60))
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      samples.push_back(random.bytes(3 * ROW_STRIDE, 60));
      surfaces.push_back(random.bytes(ROW_STRIDE, 60));
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

TEST_P(CostKernels, ArmCostEqualsThePlainVersion)
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
    RandomRows random;
    const Views views(16, random);
    std::vector<std::uint16_t> scales;
    for (const Arm& arm : test.arms)
    {
      scales.push_back(static_cast<std::uint16_t>(240 * 256 / (30 * (arm.last - arm.first))));
    }
    ArmCostRow row;
    row.reference = views.reference.data();
    row.reference_stride = ROW_STRIDE;
    row.samples = views.sample_rows.data();
    row.sample_stride = ROW_STRIDE;
    row.channels = test.channels;
    row.width = ROW_WIDTH;
    row.arms = test.arms.data();
    row.arm_count = static_cast<int>(test.arms.size());
    row.best_arms = test.best_arms;
    row.arm_scales = scales.data();
    std::vector<std::uint8_t> simd(ROW_STRIDE);
    std::vector<std::uint8_t> plain(ROW_STRIDE);
    armCostRow(row, simd.data());
    armCostRowPlain(row, plain.data());
    EXPECT_EQ(firstPart(simd, ROW_WIDTH), firstPart(plain, ROW_WIDTH)) << test.arms.size() << " arms";
  }
}

TEST_P(CostKernels, VisibleCostEqualsThePlainVersion)
{
  for (const int truncation : {20, 30, 60})
  {
    for (const int hidden_above : {0, 10, 40})
    {
      RandomRows random;
      const Views views(16, random);
      VisibleCostRow row;
      row.reference = views.reference.data();
      row.reference_stride = ROW_STRIDE;
      row.samples = views.sample_rows.data();
      row.sample_stride = ROW_STRIDE;
      row.surfaces = views.surface_rows.data();
      row.views = 16;
      row.width = ROW_WIDTH;
      row.truncation = truncation;
      row.hidden_above = hidden_above;
      row.unseen_penalty = 20;
      std::vector<std::uint8_t> simd(ROW_STRIDE);
      std::vector<std::uint8_t> plain(ROW_STRIDE);
      visibleCostRow(row, simd.data());
      visibleCostRowPlain(row, plain.data());
      EXPECT_EQ(firstPart(simd, ROW_WIDTH), firstPart(plain, ROW_WIDTH))
          << truncation << ", " << hidden_above;
    }
  }
}

TEST(MaskCosts, CompareTheOtherViewsWhereTheReferenceIsMasked)
{
  constexpr int SEEING = 4;
  // Pixel 0: all alike; 1: two of 40, two of 50, 5 off their mean; 2: two views see it; 3: the reference
  // does.
  const std::uint8_t samples[SEEING][4] = {{9, 40, 1, 7}, {9, 40, 99, 7}, {9, 50, 1, 7}, {9, 50, 99, 7}};
  const std::uint8_t masks[SEEING][4] = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 1, 0}};
  const std::uint8_t reference_masked[4] = {1, 1, 1, 0};
  std::vector<const std::uint8_t*> sample_rows;
  std::vector<const std::uint8_t*> mask_rows;
  for (int view = 0; view < SEEING; ++view)
  {
    sample_rows.push_back(samples[view]);
    mask_rows.push_back(masks[view]);
  }
  VisibleCostRow row;
  row.samples = sample_rows.data();
  row.views = SEEING;
  row.channels = 1;
  row.width = 4;
  row.truncation = 30;
  std::vector<std::uint8_t> cost(4, 77);
  maskVisibleCosts(row, {reference_masked, mask_rows.data(), SEEING}, cost.data());
  EXPECT_EQ(cost, (std::vector<std::uint8_t>{0, 5 * FULL_COST / 30, 0, 77}));
}

}  // namespace
}  // namespace light_field_depth::multiview
