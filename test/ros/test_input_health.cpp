#include "ros/input_health.h"

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
using Time = InputHealth::Time;

ViewArray array()
{
  ViewArray result;
  for (int column = 0; column < 3; ++column)
  {
    result.views.push_back({{0, column}, "cam" + std::to_string(column) + "/image", "info"});
  }
  return result;
}

ViewSynchronizerStatistics counts(std::uint64_t complete, std::uint64_t dropped,
                                  std::uint64_t missing_of_last, std::uint64_t received,
                                  std::uint64_t received_by_last)
{
  ViewSynchronizerStatistics statistics;
  statistics.sets_complete = complete;
  statistics.sets_dropped = dropped;
  statistics.views.resize(3);
  for (ViewCounts& view : statistics.views)
  {
    view.received = received;
  }
  statistics.views[2].received = received_by_last;
  statistics.views[2].missing = missing_of_last;
  return statistics;
}

void expectParts(const std::string& text, const std::vector<std::string>& parts)
{
  for (const std::string& part : parts)
  {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
  }
}

HealthReport after(const ViewSynchronizerStatistics& now, std::uint64_t replaced = 0, double latency_ms = 0.0,
                   const HealthThresholds& thresholds = {})
{
  InputHealth health(array(), 5, thresholds);
  health.add(Time(), counts(0, 0, 0, 0, 0), 0);
  health.add(Time() + std::chrono::seconds(1), now, replaced);
  return health.report(latency_ms);
}

TEST(InputHealth, IsWellWhileSetsAreWhole)
{
  EXPECT_EQ(after(counts(30, 0, 0, 30, 30)).health, Health::Ok);
  EXPECT_EQ(after(counts(99, 1, 1, 100, 99)).health, Health::Ok) << "one lost image in a hundred sets";
}

TEST(InputHealth, NamesTheCameraThatLosesImages)
{
  const HealthReport report = after(counts(2, 28, 28, 30, 2));
  EXPECT_EQ(report.health, Health::Error);
  expectParts(report.sentence, {"28 of the last 30", "View (0, 2) (cam2/image)", "sent 2", "cable"});
  EXPECT_EQ(after(counts(27, 3, 3, 30, 27)).health, Health::Warn);
}

TEST(InputHealth, TellsOtherStampsFromLateImages)
{
  ViewSynchronizerStatistics statistics = counts(2, 28, 28, 30, 30);
  expectParts(after(statistics).sentence, {"sync_tolerance"});
  statistics.views[2].late = 20;
  statistics.views[2].late_by_sets = 12;
  expectParts(after(statistics).sentence, {"12 sets late", "queue_size (5)"});
}

TEST(InputHealth, WarnsOfReplacedSets)
{
  const HealthReport report = after(counts(76, 0, 0, 76, 76), 47);
  EXPECT_EQ(report.health, Health::Warn);
  expectParts(report.sentence, {"47 of the last 76", "realtime"});
}

TEST(InputHealth, LooksAtTheLatencyOnlyWhenAskedTo)
{
  EXPECT_EQ(after(counts(30, 0, 0, 30, 30), 0, 5000.0).health, Health::Ok);
  HealthThresholds thresholds;
  thresholds.warn_latency_s = 1.0;
  thresholds.error_latency_s = 10.0;
  EXPECT_EQ(after(counts(30, 0, 0, 30, 30), 0, 5000.0, thresholds).health, Health::Warn);
  EXPECT_EQ(after(counts(30, 0, 0, 30, 30), 0, 12000.0, thresholds).health, Health::Error);
}

TEST(InputHealth, ForgetsWhatIsLongAgo)
{
  InputHealth health(array(), 5, {});
  health.add(Time(), counts(0, 0, 0, 0, 0), 0);
  for (int second = 1; second < 30; ++second)
  {
    health.add(Time() + std::chrono::seconds(second),
               counts(static_cast<std::uint64_t>(10 * second), 20, 20, 10, 10), 0);
  }
  EXPECT_EQ(health.report(0.0).health, Health::Ok);
}

}  // namespace
}  // namespace light_field_depth
