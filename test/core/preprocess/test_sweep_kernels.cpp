#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/preprocess/sweep_kernels.h"
#include "support/instruction_sets.h"

namespace light_field_depth
{
namespace
{
std::vector<std::uint16_t> randomWords(cv::RNG& random, std::size_t count, int most)
{
  std::vector<std::uint16_t> words(count);
  std::generate(words.begin(), words.end(),
                [&] { return static_cast<std::uint16_t>(random.uniform(0, most + 1)); });
  return words;
}

class SweepKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, SweepKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(SweepKernels, KeepTheBestAndItsRival)
{
  constexpr int LABELS = 20;
  constexpr int DISTANCE = 3;
  constexpr std::size_t COUNT = 77;
  cv::RNG random(4);
  std::vector<std::vector<std::uint16_t>> costs;
  costs.reserve(LABELS);
  for (int label = 0; label < LABELS; ++label)
  {
    costs.push_back(randomWords(random, COUNT, 60000));
  }
  std::vector<std::uint16_t> best(COUNT, 0xFFFF);
  std::vector<std::uint16_t> best_label(COUNT, 0);
  std::vector<std::uint16_t> rival = best;
  for (std::uint16_t label = 0; label < LABELS; ++label)
  {
    keepBest(costs[label].data(), label, COUNT, best.data(), best_label.data());
  }
  for (std::uint16_t label = 0; label < LABELS; ++label)
  {
    keepRival(costs[label].data(), label, best_label.data(), DISTANCE, COUNT, rival.data());
  }
  for (std::size_t i = 0; i < COUNT; ++i)
  {
    int expected_rival = 0xFFFF;
    for (int label = 0; label < LABELS; ++label)
    {
      const int cost = costs[static_cast<std::size_t>(label)][i];
      EXPECT_GE(cost, best[i]);
      expected_rival =
          std::abs(label - best_label[i]) >= DISTANCE ? std::min(expected_rival, cost) : expected_rival;
    }
    EXPECT_EQ(costs[best_label[i]][i], best[i]);
    EXPECT_EQ(rival[i], expected_rival);
  }
}

TEST_P(SweepKernels, ExposeEveryByteValue)
{
  constexpr std::size_t COUNT = 256 + 5;
  std::vector<std::uint8_t> values(COUNT);
  for (std::size_t i = 0; i < COUNT; ++i)
  {
    values[i] = static_cast<std::uint8_t>(i);
  }
  cv::RNG random(5);
  std::vector<float> factor(COUNT);
  std::vector<float> gain(COUNT);
  std::vector<float> offset(COUNT);
  for (std::size_t i = 0; i < COUNT; ++i)
  {
    factor[i] = random.uniform(0.5F, 2.0F);
    gain[i] = random.uniform(0.5F, 2.0F);
    offset[i] = random.uniform(-30.0F, 30.0F);
  }
  constexpr float SHADING = 0.1F;
  std::vector<std::uint8_t> exposed(COUNT);
  exposeBytes(values.data(), {factor.data(), gain.data(), offset.data(), SHADING}, COUNT, exposed.data());
  for (std::size_t i = 0; i < COUNT; ++i)
  {
    const float expected = values[i] * (factor[i] + SHADING * gain[i]) + offset[i];
    EXPECT_NEAR(exposed[i], std::clamp(expected, 0.0F, 255.0F), 0.5F + 1e-3F) << "value " << int{values[i]};
  }
}

}  // namespace
}  // namespace light_field_depth
