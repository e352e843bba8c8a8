// The inputs that fuzzing began with and everything that it ever found, as ordinary tests.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "fuzz/harnesses.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth::fuzz
{
namespace
{
class FuzzCorpus : public ::testing::TestWithParam<Harness>
{
};

TEST_P(FuzzCorpus, HoldsNoFinding)
{
  std::vector<std::filesystem::path> inputs;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path("test/fuzz/corpus") / GetParam().name))
  {
    inputs.push_back(entry.path());
  }
  ASSERT_FALSE(inputs.empty());
  std::sort(inputs.begin(), inputs.end());
  for (const std::filesystem::path& input : inputs)
  {
    SCOPED_TRACE(input.filename().string());
    const std::string bytes = readFile(input);
    GetParam().run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
}

/// As many as LIGHT_FIELD_DEPTH_RANDOM_INPUTS says (200 by default); a finding ends the program.
TEST(RandomInputs, GiveTheEstimatorARightAnswerOrASentence)
{
  constexpr int USUAL = 200;
  const char* const wanted = std::getenv("LIGHT_FIELD_DEPTH_RANDOM_INPUTS");
  const int count = wanted == nullptr ? USUAL : std::atoi(wanted);
  for (int seed = 0; seed < count; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937 random(static_cast<std::uint32_t>(seed));
    std::vector<std::uint8_t> bytes(130 + random() % 300);
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::uint8_t>(random()); });
    fuzzEstimator(bytes.data(), bytes.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpus, ::testing::ValuesIn(HARNESSES),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace light_field_depth::fuzz
