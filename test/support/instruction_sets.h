#ifndef LIGHT_FIELD_DEPTH_TEST_SUPPORT_INSTRUCTION_SETS_H
#define LIGHT_FIELD_DEPTH_TEST_SUPPORT_INSTRUCTION_SETS_H

#include <cstdint>
#include <string>

#include <gtest/gtest.h>
#include <hwy/targets.h>

namespace light_field_depth::testing
{
/// A test that runs with the vector kernels of one instruction set.
class InstructionSetTest : public ::testing::TestWithParam<std::int64_t>
{
protected:
  void SetUp() override { bindTo(GetParam()); }
  void TearDown() override { bindTo(0); }

private:
  /// @param targets 0 for the best of this processor
  static void bindTo(std::int64_t targets)
  {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().DeInit();
  }
};

/// Those that the library is compiled for and this processor has.
inline auto everyInstructionSet()
{
  return ::testing::ValuesIn(hwy::SupportedAndGeneratedTargets());
}

inline std::string instructionSetName(const ::testing::TestParamInfo<std::int64_t>& info)
{
  return hwy::TargetName(info.param);
}

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_SUPPORT_INSTRUCTION_SETS_H
