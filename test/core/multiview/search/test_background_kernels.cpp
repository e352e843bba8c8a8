#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/multiview/search/background_kernels.h"
#include "support/instruction_sets.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int LABELS = 24;

/// Rows of tiles with random costs, whose bands differ.
class BackgroundKernelsTest : public testing::InstructionSetTest
{
protected:
  std::vector<std::uint8_t> randomBytes(std::size_t count)
  {
    std::vector<std::uint8_t> values(count);
    std::generate(values.begin(), values.end(), [&] { return static_cast<std::uint8_t>(engine_()); });
    return values;
  }

  TileLine randomLine(int first, int end)
  {
    memory_.push_back(randomBytes(static_cast<std::size_t>(end - first) * TILE_PX));
    return {memory_.back().data(), {first, end - first}};
  }

  /// As maps have them: mostly the same label as the pixel on the left.
  std::vector<std::int16_t> randomLabels()
  {
    std::vector<std::int16_t> labels(TILE_PX);
    std::int16_t label = 0;
    for (std::size_t x = 0; x < labels.size(); ++x)
    {
      if (x % 5 == 0)
      {
        label = static_cast<std::int16_t>(static_cast<int>(engine_() % (LABELS + 1)) - 1);
      }
      labels[x] = label;
    }
    return labels;
  }

  std::mt19937 engine_{17};
  std::vector<std::vector<std::uint8_t>> memory_;
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, BackgroundKernelsTest, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(BackgroundKernelsTest, CostsAtTheLabelsEqualThePlainVersion)
{
  std::uniform_real_distribution<float> distribution(-1.0F, LABELS + 1.0F);
  std::vector<float> label(TILE_PX);
  std::generate(label.begin(), label.end(), [&] { return distribution(engine_); });
  label[3] = 7.0F;
  label[4] = 7.5F;
  for (const auto& band : {LabelBand{0, LABELS}, LabelBand{5, 9}, LabelBand{7, 1}, LabelBand{7, 2}})
  {
    const TileLine line = randomLine(band.first, band.end());
    for (const int count : {TILE_PX, 21, 1})
    {
      std::vector<float> cost(TILE_PX);
      std::vector<float> plain(TILE_PX);
      std::vector<std::int16_t> rounded(TILE_PX);
      std::vector<std::int16_t> rounded_plain(TILE_PX);
      findLabelCosts({line, label.data(), count, cost.data(), rounded.data()});
      findLabelCostsPlain({line, label.data(), count, plain.data(), rounded_plain.data()});
      EXPECT_EQ(cost, plain) << band.first << " + " << band.count;
      EXPECT_EQ(rounded, rounded_plain);
      if (count > 4)
      {
        EXPECT_EQ(plain[3], static_cast<float>(line.at(7)[3]));
        EXPECT_EQ(rounded[4], 8);
      }
    }
  }
}

TEST_P(BackgroundKernelsTest, SupportedPixelsEqualThePlainVersion)
{
  int supported = 0;
  for (int round = 0; round < 200; ++round)
  {
    const auto lines = [&]
    {
      const int first = static_cast<int>(engine_() % 3);
      const TileLine upper = randomLine(first, LABELS);
      const TileLine lower = randomLine(0, LABELS - first);
      return round % 2 == 0 ? SupportLine::Lines{upper, upper, lower}
                            : SupportLine::Lines{upper, lower, lower};
    };
    SupportLine line;
    line.here = lines();
    line.left = round % 7 == 0 ? SupportLine::Lines{} : lines();
    line.right = round % 11 == 0 ? SupportLine::Lines{} : lines();
    line.distance = 1 + round % 3;
    line.threshold = round % 13 == 0 ? -NO_SUPPORT : round % 17 == 0 ? NO_SUPPORT : round;
    auto labels = randomLabels();
    std::vector<int> counts(LABELS);
    std::vector<int> plain(LABELS);
    countSupportedPlain(line, labels.data(), plain.data());
    countSupported(line, labels.data(), counts.data());
    ASSERT_EQ(counts, plain) << round;
    supported += std::accumulate(plain.begin(), plain.end(), 0);
  }
  EXPECT_GT(supported, 200);
}

/// Costs that are 10 at one label and 16 beside it: 9 pixels of 12.
TEST_P(BackgroundKernelsTest, ThePixelsInTheMiddleOfAValleyAreSupported)
{
  constexpr std::int16_t label = 4;
  std::vector<std::uint8_t> costs(static_cast<std::size_t>(LABELS) * TILE_PX, 16);
  std::fill_n(costs.begin() + label * TILE_PX, TILE_PX, 10);
  const TileLine line{costs.data(), {0, LABELS}};
  SupportLine support;
  support.here = support.left = {line, line, line};
  std::vector<std::int16_t> labels(TILE_PX, label);
  labels[5] = NO_LABEL;
  for (const int sum : {9 * 12 - 1, 9 * 12})
  {
    support.threshold = sum;
    auto counted = labels;
    std::vector<int> counts(LABELS);
    countSupported(support, counted.data(), counts.data());
    // Neither the one without a label nor the last one, beside which there is no tile.
    EXPECT_EQ(counts[label], sum < 9 * 12 ? TILE_PX - 2 : 0);
  }
}

TEST_P(BackgroundKernelsTest, ChargesEqualThePlainVersionAndStopAt255)
{
  const auto charge = randomBytes(LABELS);
  auto costs = randomBytes(static_cast<std::size_t>(LABELS) * TILE_PX);
  auto plain = costs;
  addCharges(charge.data(), LABELS, costs.data());
  addChargesPlain(charge.data(), LABELS, plain.data());
  EXPECT_EQ(costs, plain);
  EXPECT_GT(std::count(plain.begin(), plain.end(), 255), 20);
}

}  // namespace
}  // namespace light_field_depth::multiview
