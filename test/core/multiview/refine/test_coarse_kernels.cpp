#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "core/multiview/refine/coarse_kernels.h"
#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
using testing::randomRow;

const std::vector<int> WIDTHS = {1, 2, 3, 31, 32, 67, 130};

/// Everything that a row of the system reads.
struct Row
{
  explicit Row(int width)
      : weight(randomRow(width, 0.0F, 400.0F)), target(randomRow(width, -3.0F, 3.0F)),
        left(randomRow(width + 1, 0.0F, 200.0F)), up(randomRow(width, 0.0F, 200.0F)),
        down(randomRow(width, 0.0F, 200.0F)), above(randomRow(width, -3.0F, 3.0F)),
        below(randomRow(width, -3.0F, 3.0F)), values(randomRow(width, -3.0F, 3.0F))
  {
    left.front() = left.back() = 0.0F;
  }

  SystemRow row()
  {
    return {weight.data(), target.data(), left.data(),  up.data(),
            down.data(),   above.data(),  below.data(), values.data()};
  }

  std::vector<float> weight, target, left, up, down, above, below, values;
};

struct Sums
{
  explicit Sums(int width) : weight(static_cast<std::size_t>(width)), residual(weight), left(weight) {}
  CellSums pointers() { return {weight.data(), residual.data(), left.data()}; }

  std::vector<float> weight, residual, left;
};

class CoarseKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, CoarseKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(CoarseKernels, ResidualsEqualThePlainVersion)
{
  for (const int width : WIDTHS)
  {
    Sums simd(width);
    Sums plain(width);
    for (const bool add : {false, true})
    {
      Row row(width);
      sumResiduals(row.row(), width, add, simd.pointers());
      sumResidualsPlain(row.row(), width, add, plain.pointers());
    }
    EXPECT_EQ(simd.weight, plain.weight) << width;
    EXPECT_EQ(simd.residual, plain.residual) << width;
    EXPECT_EQ(simd.left, plain.left) << width;
  }
}

TEST_P(CoarseKernels, JoinedCellsEqualThePlainVersion)
{
  for (const int width : WIDTHS)
  {
    Sums sums(width);
    sums.weight = randomRow(width, 1.0F, 400.0F);
    sums.residual = randomRow(width, -9.0F, 9.0F);
    sums.left = randomRow(width, 0.0F, 200.0F);
    const std::vector<float> up = randomRow(width, 0.0F, 200.0F);
    const auto coarse = static_cast<std::size_t>((width + 1) / 2);
    std::vector<std::vector<float>> results(8, std::vector<float>(coarse + 1, -1.0F));
    joinCells({sums.pointers(), up.data(), width, results[0].data(), results[1].data(), results[2].data(),
               results[3].data()});
    joinCellsPlain({sums.pointers(), up.data(), width, results[4].data(), results[5].data(),
                    results[6].data(), results[7].data()});
    for (std::size_t i = 0; i < 4; ++i)
    {
      EXPECT_EQ(results[i], results[i + 4]) << width;
    }
    EXPECT_EQ(results[2].back(), 0.0F);
    EXPECT_EQ(results[3].back(), -1.0F);
  }
}

TEST_P(CoarseKernels, SpreadRowsEqualThePlainVersion)
{
  for (const int width : WIDTHS)
  {
    const std::vector<float> coarse = randomRow((width + 1) / 2, -1.0F, 1.0F);
    std::vector<float> simd = randomRow(width, -3.0F, 3.0F);
    std::vector<float> plain = simd;
    spreadRow(coarse.data(), 0.7F, width, simd.data());
    spreadRowPlain(coarse.data(), 0.7F, width, plain.data());
    EXPECT_EQ(simd, plain) << width;
  }
}

TEST_P(CoarseKernels, GainsEqualThePlainVersion)
{
  for (const int width : WIDTHS)
  {
    Row row(width);
    std::vector<float> gain = randomRow(width, 0.0F, 9.0F);
    std::vector<float> charge = randomRow(width, 0.0F, 9.0F);
    std::vector<float> plain_gain = gain;
    std::vector<float> plain_charge = charge;
    sumGains(row.row(), width, gain.data(), charge.data());
    sumGainsPlain(row.row(), width, plain_gain.data(), plain_charge.data());
    EXPECT_EQ(gain, plain_gain) << width;
    EXPECT_EQ(charge, plain_charge) << width;
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
