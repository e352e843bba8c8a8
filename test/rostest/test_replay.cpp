#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <stereo_msgs/DisparityImage.h>

#include "array_fixture.h"
#include "light_field_depth/LightFieldDepthStats.h"

// The launch file writes a bag of a folder's light field and replays it in a loop with the bag's clock.
namespace light_field_depth::testing
{
namespace
{
TEST(Replay, OfABagGivesFrameAfterFrame)
{
  ros::AsyncSpinner spinner(2);
  spinner.start();
  const ros::NodeHandle node("/light_field_depth");
  const Listener<LightFieldDepthStats> stats(node, "stats");
  const Listener<stereo_msgs::DisparityImage> disparity(node, "disparity");
  const Listener<sensor_msgs::PointCloud2> cloud(node, "points_dense");
  EXPECT_TRUE(waitFor([&] { return stats.count() >= 6 && disparity.count() > 0 && cloud.count() > 0; },
                      std::chrono::seconds(60)));
  ASSERT_GT(stats.count(), 0U);
  EXPECT_EQ(stats.newest()->views_expected, 9U);
  EXPECT_EQ(stats.newest()->frames_failed, 0U);
  EXPECT_GE(stats.newest()->time_jumps, 1U) << "six frames of a bag of three: it has looped";
  EXPECT_GT(disparity.newest()->T, 0.0F);
  EXPECT_GT(cloud.newest()->width, 1000U);
}

}  // namespace
}  // namespace light_field_depth::testing

int main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_replay");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
