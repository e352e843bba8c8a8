#include "io/number_text.h"

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
TEST(NumberText, TakesWholeTextsOnly)
{
  EXPECT_EQ(numberFromText<double>(" 2.5\t"), 2.5);
  EXPECT_EQ(numberFromText<double>("1e-3"), 1e-3);
  EXPECT_EQ(numberFromText<int>("-17"), -17);
  EXPECT_FALSE(numberFromText<double>("2.5 m"));
  EXPECT_FALSE(numberFromText<double>("2,5"));
  EXPECT_FALSE(numberFromText<double>(""));
  EXPECT_FALSE(numberFromText<int>("2.5"));
  EXPECT_FALSE(numberFromText<int>("99999999999"));
}

}  // namespace
}  // namespace light_field_depth
