// The inputs that fuzzing began with and everything that it ever found, as ordinary tests.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
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

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpus, ::testing::ValuesIn(HARNESSES),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace light_field_depth::fuzz
