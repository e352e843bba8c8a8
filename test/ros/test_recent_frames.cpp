#include "ros/recent_frames.h"

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
using std::chrono::milliseconds;

RecentFrames::Time after(milliseconds time)
{
  return RecentFrames::Time() + std::chrono::hours(1) + time;
}

TEST(RecentFrames, HaveNoFiguresBeforeTheFirst)
{
  const auto summary = RecentFrames().summary();
  EXPECT_EQ(summary.frames, 0U);
  EXPECT_EQ(summary.rate_hz, 0.0);
}

TEST(RecentFrames, GivePercentilesByRankAndTheRate)
{
  RecentFrames recent;
  for (int i = 0; i < 200; ++i)
  {
    recent.add((i * 77) % 200 + 1, after(milliseconds(100 * i)));  // each of 1..200 once
  }
  const auto summary = recent.summary();
  EXPECT_EQ(summary.frames, 200U);
  EXPECT_DOUBLE_EQ(summary.median_ms, 100.0);
  EXPECT_DOUBLE_EQ(summary.p99_ms, 198.0);
  EXPECT_DOUBLE_EQ(summary.longest_ms, 200.0);
  EXPECT_NEAR(summary.rate_hz, 10.0, 1e-9);
}

TEST(RecentFrames, OfASingleFrameAreThatFrame)
{
  RecentFrames recent;
  recent.add(5.0, after(milliseconds(0)));
  EXPECT_DOUBLE_EQ(recent.summary().median_ms, 5.0);
  EXPECT_DOUBLE_EQ(recent.summary().p99_ms, 5.0);
  EXPECT_EQ(recent.summary().rate_hz, 0.0);
}

TEST(RecentFrames, ForgetWhatIsLongAgo)
{
  RecentFrames recent;
  recent.add(1000.0, after(milliseconds(0)));
  recent.add(1.0, after(milliseconds(60001)));
  EXPECT_EQ(recent.summary().frames, 1U);
  EXPECT_DOUBLE_EQ(recent.summary().longest_ms, 1.0);
  for (std::size_t i = 0; i < RecentFrames::MAX_FRAMES; ++i)
  {
    recent.add(2.0, after(milliseconds(60002)));
  }
  EXPECT_EQ(recent.summary().frames, RecentFrames::MAX_FRAMES);
  EXPECT_DOUBLE_EQ(recent.summary().p99_ms, 2.0);
}

}  // namespace
}  // namespace light_field_depth
