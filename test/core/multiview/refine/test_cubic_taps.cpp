#include <array>

#include <gtest/gtest.h>

#include "core/multiview/refine/cubic_taps.h"

namespace light_field_depth::multiview
{
namespace
{
TEST(CubicTaps, InterpolateAndAddUpToOne)
{
  for (int i = 0; i < 1000; ++i)
  {
    const float t = static_cast<float>(i) / 1000.0F;
    const auto weights = cubicTaps(t);
    EXPECT_EQ(weights[0] + weights[1] + weights[2] + weights[3], TAP_MOST);
    const float exact = ((2.0F - 1.5F * t) * t + 0.5F) * t;
    EXPECT_NEAR(static_cast<float>(weights[2]) / TAP_ONE, exact, 1e-4F);
  }
  EXPECT_EQ(cubicTaps(0.0F), (std::array<int, 4>{0, TAP_MOST, 0, 0}));
}

}  // namespace
}  // namespace light_field_depth::multiview
