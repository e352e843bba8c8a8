#include "ros/log_throttle.h"

#include <map>

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
LogThrottle::Time after(std::chrono::milliseconds time)
{
  return LogThrottle::Time() + std::chrono::hours(1) + time;
}

TEST(LogThrottle, AreNewsOnceInAWhileEvenWhenTheyTakeTurns)
{
  LogThrottle sentences;
  std::map<std::string, int> told;
  for (std::chrono::milliseconds time(0); time < std::chrono::seconds(25);
       time += std::chrono::milliseconds(50))
  {
    for (const char* const sentence : {"The baselines differ.", "View (0, 1) stands far from its place."})
    {
      told[sentence] += sentences.isNews(sentence, after(time)) ? 1 : 0;
    }
  }
  for (const auto& [sentence, times] : told)
  {
    EXPECT_EQ(times, 3) << sentence;  // after 0, 10 and 20 seconds
  }
}

}  // namespace
}  // namespace light_field_depth
