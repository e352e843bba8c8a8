#include <optional>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/paper2017/epipolar_line.h"

namespace light_field_depth
{
namespace
{
TEST(EpipolarLine, OfARowRunsAlongXAgainstTheDisparity)
{
  const EpipolarLine line({{1.0, 0.0}, {0.0, 0.0}}, 1.0, {100, 80}, DisparityRange{-2.0F, 3.0F}, 40.0);
  EXPECT_EQ(line.min(), -3);
  EXPECT_EQ(line.max(), 2);
  EXPECT_EQ(line.target({10, 20}, -3), cv::Point(7, 20));
  EXPECT_EQ(line.disparity(-3.0F), 3.0F);
}

TEST(EpipolarLine, OfAColumnRunsAlongY)
{
  const EpipolarLine line({{0.0, 1.0}, {0.0, 0.5}}, 0.5, {100, 80}, DisparityRange{-2.0F, 3.0F}, 40.0);
  EXPECT_EQ(line.target({10, 20}, 1), cv::Point(10, 21));
  EXPECT_EQ(line.disparity(0.25F), 0.0F);  // the offset alone, at half the size
}

TEST(EpipolarLine, IsOnlyAsLongAsTheImage)
{
  const EpipolarLine line({{1.0, 0.0}, {0.0, 0.0}}, 1.0, {20, 80}, std::nullopt, 40.0);
  EXPECT_EQ(line.min(), -19);
  EXPECT_EQ(line.max(), 19);
}

}  // namespace
}  // namespace light_field_depth
