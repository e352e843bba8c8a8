#include <algorithm>
#include <chrono>
#include <iostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <stereo_msgs/DisparityImage.h>

#include "array_fixture.h"
#include "light_field_depth/LightFieldDepthStats.h"

// A camera array at a steady rate. The rate follows the machine; `./run bench --node` has figures of the demo
// at 10 Hz.
namespace light_field_depth::testing
{
namespace
{
using NodeRateTest = ArrayFixture;
using StatsListener = Listener<LightFieldDepthStats>;

constexpr int SETS_ONE_BY_ONE = 5;
constexpr std::size_t SETS_AT_A_RATE = 40;
/// Of the rate that sets brought one by one suggest, the first is held by a machine with nothing else to do.
constexpr double SHARES_OF_THE_RATE[] = {0.5, 0.25, 0.1};

/// The longest latency of some sets, each brought when the one before is done.
double longestLatency(ArrayPublisher& array, const StatsListener& stats,
                      const std::function<ros::Time()>& stamp)
{
  double longest_ms = 0.0;
  for (int i = 0; i < SETS_ONE_BY_ONE; ++i)
  {
    const std::size_t before = stats.count();
    array.publish(stamp());
    EXPECT_TRUE(waitFor([&] { return stats.count() > before; }));
    longest_ms = std::max(longest_ms, stats.newest()->latency_ms);
  }
  return longest_ms;
}

TEST_F(NodeRateTest, DropsNoSetAtARateThatTheMachineHolds)
{
  const SyntheticLightField scene = syntheticArray(crossPositions(9, 9), {128, 96});
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  const Listener<stereo_msgs::DisparityImage> disparity(*node_space_, "disparity");
  const Listener<sensor_msgs::PointCloud2> points2(*node_space_, "points2");
  const Listener<sensor_msgs::PointCloud2> points_dense(*node_space_, "points_dense");
  ASSERT_TRUE(waitFor([&] { return array.topicsHeard() == array.topics(); }));
  ASSERT_TRUE(publishUntil(array, [&] { return stats.count() > 0 && points_dense.count() > 0; }));
  const double one_by_one_ms = longestLatency(array, stats, [this] { return nextStamp(); });

  bool held = false;
  for (const double share : SHARES_OF_THE_RATE)
  {
    const std::uint64_t dropped_before = stats.newest()->frames_dropped;
    const std::size_t frames_before = stats.count();
    ros::WallRate rate(share * 1000.0 / one_by_one_ms);
    for (std::size_t i = 0; i < SETS_AT_A_RATE; ++i)
    {
      array.publish(nextStamp());
      rate.sleep();
    }
    const bool all_came =
        waitFor([&] { return stats.count() >= frames_before + SETS_AT_A_RATE; }, std::chrono::seconds(5));
    const LightFieldDepthStats& last = *stats.newest();
    std::cout << "at " << share * 1000.0 / one_by_one_ms << " Hz: " << last.frames_dropped - dropped_before
              << " of " << SETS_AT_A_RATE << " sets dropped, latency " << last.recent_latency_median_ms
              << " ms (median), " << last.recent_latency_p99_ms << " ms (99th percentile)" << std::endl;
    EXPECT_EQ(last.sets_incomplete, 0U);
    EXPECT_EQ(last.frames_failed, 0U);
    held = all_came && last.frames_dropped == dropped_before;
    if (held)
    {
      break;
    }
  }
  EXPECT_TRUE(held) << "at a tenth of the rate that sets one by one had";
}

TEST_F(NodeRateTest, PublishesFramesInTheirOrderWithFiguresThatFitEachOther)
{
  const SyntheticLightField scene = syntheticArray(crossPositions(3, 3), {64, 48});
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  const Listener<sensor_msgs::PointCloud2> points2(*node_space_, "points2");
  ASSERT_TRUE(publishUntil(array, [&] { return stats.count() >= 10 && points2.count() >= 10; }));
  const auto frames = stats.all();
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    const LightFieldDepthStats& frame = *frames[i];
    EXPECT_EQ(frame.frames_published, i + 1);
    EXPECT_EQ(frame.recent_frames, i + 1);
    EXPECT_GE(frame.sets_complete, frame.frames_published + frame.frames_dropped);
    EXPECT_LE(frame.recent_latency_median_ms, frame.recent_latency_p99_ms);
    EXPECT_LE(frame.recent_latency_p99_ms, frame.recent_latency_longest_ms);
    EXPECT_GE(frame.recent_latency_longest_ms, frame.latency_ms);
    EXPECT_NEAR(frame.latency_ms,
                frame.waiting_ms + frame.conversion_ms + frame.pipeline_ms + frame.publication_ms, 1e-3);
    if (i > 0)
    {
      EXPECT_GT(frame.header.stamp, frames[i - 1]->header.stamp);
      EXPECT_GT(frame.recent_rate_hz, 0.0);
    }
  }
}

}  // namespace
}  // namespace light_field_depth::testing

int main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_node_rate");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
