#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "core/preprocess/elimination_kernels.h"
#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth
{
namespace
{
class EliminationKernels : public testing::InstructionSetTest
{
};

TEST_P(EliminationKernels, LeaveWhatIsLeftOfTheTriangle)
{
  constexpr int size = 21;
  constexpr int stride = 2 * ELIMINATED_FLOATS;
  constexpr float own = 3.7F;
  std::vector<float> values = testing::randomValues<float>(stride, -20, 20, 1);
  values[4] = 0.0F;
  std::fill(values.begin() + size, values.end(), 0.0F);
  const std::vector<float> before =
      testing::randomValues<float>(static_cast<std::size_t>(size) * stride, -90, 90, 2);
  std::vector<float> matrix = before;
  eliminateUnknown(values.data(), own, size, stride, matrix.data());
  for (int a = 0; a < size; ++a)
  {
    for (int b = a; b < size; ++b)
    {
      const auto at = static_cast<std::size_t>(a * stride + b);
      const float part = values[static_cast<std::size_t>(a)] / own;
      EXPECT_FLOAT_EQ(matrix[at], before[at] - part * values[static_cast<std::size_t>(b)]) << a << ", " << b;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, EliminationKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

}  // namespace
}  // namespace light_field_depth
