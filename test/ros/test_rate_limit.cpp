#include "ros/rate_limit.h"

#include <utility>

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
/// Of frames at 10 Hz for two seconds.
int dueOf(RateLimit& limit, double max_rate_hz, double begin_s = 100.0)
{
  int due = 0;
  for (int frame = 0; frame < 20; ++frame)
  {
    const double jitter_s = frame % 2 == 0 ? 0.003 : -0.003;
    due += limit.isDue(ros::Time(begin_s + 0.1 * frame + jitter_s), max_rate_hz) ? 1 : 0;
  }
  return due;
}

TEST(RateLimit, LetsSoManyFramesASecondThrough)
{
  for (const auto& [max_rate_hz, expected] : {std::pair(0.0, 20), std::pair(30.0, 20), std::pair(10.0, 20),
                                              std::pair(5.0, 10), std::pair(2.0, 4), std::pair(0.4, 1)})
  {
    RateLimit limit;
    EXPECT_EQ(dueOf(limit, max_rate_hz), expected) << max_rate_hz;
  }
}

TEST(RateLimit, ABagThatBeginsAgainIsDue)
{
  RateLimit limit;
  EXPECT_TRUE(limit.isDue(ros::Time(100.0), 1.0));
  EXPECT_FALSE(limit.isDue(ros::Time(100.5), 1.0));
  EXPECT_TRUE(limit.isDue(ros::Time(50.0), 1.0));
}

}  // namespace
}  // namespace light_field_depth
