#include <gtest/gtest.h>

#include "core/multiview/search/label_space.h"

namespace light_field_depth::multiview
{
namespace
{
TEST(LabelSpace, CoversAnyRangeWithFewLabels)
{
  constexpr int most = 240;
  for (const float reach : {0.01F, 3.0F, 1e3F, 1e9F, 1e30F})
  {
    const LabelSpace labels = makeLabelSpace({-reach, 0.5F * reach}, 0.125F, most);
    EXPECT_GE(labels.count, 2) << reach;
    EXPECT_LE(labels.count, most) << reach;
    EXPECT_LE(labels.disparity(0.0F), -reach);
    EXPECT_GE(labels.disparity(static_cast<float>(labels.count - 1)), 0.5F * reach);
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
