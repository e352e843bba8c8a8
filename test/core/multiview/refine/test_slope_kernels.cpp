#include "core/multiview/refine/slope_kernels.h"

#include <vector>

#include <gtest/gtest.h>

#include "support/instruction_sets.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
class SlopeKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, SlopeKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(SlopeKernels, ChangesEqualThePlainVersion)
{
  RandomRows random;
  const auto disparity = random.floats(2 * ROW_STRIDE, -0.1F, 0.1F);
  const auto weight = random.floats(2 * ROW_STRIDE, 0.0F, 60.0F);
  const auto guide = random.floats(ROW_STRIDE, 0.0F, 200.0F);
  for (const int width : {1, 7, 33, ROW_WIDTH})
  {
    for (const int first : {0, 1})
    {
      auto changes = random.floats(ROW_STRIDE, -1.0F, 1.0F);
      auto shares = random.floats(ROW_STRIDE, 0.0F, 9.0F);
      auto changes_plain = changes;
      auto shares_plain = shares;
      ChangeRow row{disparity.data() + ROW_STRIDE,
                    disparity.data(),
                    weight.data() + ROW_STRIDE,
                    weight.data(),
                    guide.data(),
                    20.0F,
                    0.06F,
                    0.002F,
                    first,
                    width,
                    changes.data(),
                    shares.data()};
      addChanges(row);
      row.change_sums = changes_plain.data();
      row.share_sums = shares_plain.data();
      addChangesPlain(row);
      EXPECT_EQ(changes, changes_plain) << width;
      EXPECT_EQ(shares, shares_plain) << width;
    }
  }
}

TEST_P(SlopeKernels, LeaningTargetsEqualThePlainVersion)
{
  RandomRows random;
  const auto numbers = random.floats(8 * ROW_STRIDE, 0.0F, 3.0F);
  const auto row_of = [&](std::size_t i) { return numbers.data() + i * ROW_STRIDE; };
  for (const int width : {1, 7, 33, ROW_WIDTH})
  {
    std::vector<float> leaning(ROW_STRIDE, -1.0F);
    std::vector<float> plain(ROW_STRIDE, -1.0F);
    LeaningRow row{row_of(0), row_of(1), row_of(2), row_of(3), row_of(4),
                   row_of(5), row_of(6), row_of(7), width,     leaning.data()};
    leanRow(row);
    row.leaning = plain.data();
    leanRowPlain(row);
    EXPECT_EQ(leaning, plain) << width;
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
