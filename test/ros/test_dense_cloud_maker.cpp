#include "ros/dense_cloud_maker.h"

#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "light_field_depth/ros/result_messages.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
constexpr std::chrono::seconds DEADLINE(60);

FinishedFrame solvedFrame()
{
  testing::SceneSettings settings;
  settings.positions = testing::crossPositions(3, 3);
  settings.size = {64, 48};
  settings.calibration = Calibration{100.0, {31.5, 23.5}, 0.1, 5.0};
  FinishedFrame frame;
  frame.header.frame_id = "array_optical_frame";
  frame.light_field = testing::renderScene(testing::standardScene(settings.size), settings).light_field;
  const auto node_settings = std::make_shared<NodeSettings>();
  node_settings->pipeline.dense_cloud.maps = 3;
  frame.settings = node_settings;
  ProductRequest request;
  request.dense_cloud_later = true;
  frame.estimate = Pipeline(1).run(frame.light_field, node_settings->pipeline, request).estimate;
  return frame;
}

/// A frame that a pipeline has finished but for its dense cloud.
FinishedFrame finishedFrame(double stamp_s = 1.0)
{
  static const FinishedFrame solved = solvedFrame();
  FinishedFrame frame = solved;
  frame.header.stamp = ros::Time(stamp_s);
  return frame;
}

std::string bytesOf(const sensor_msgs::PointCloud2& cloud)
{
  return {cloud.data.begin(), cloud.data.end()};
}

void unexpected(const std::string& sentence)
{
  ADD_FAILURE() << sentence;
}

TEST(DenseCloudMaker, MakesTheCloudThatARunWouldMake)
{
  const FinishedFrame frame = finishedFrame();
  std::promise<sensor_msgs::PointCloud2Ptr> made;
  DenseCloudMaker maker(
      2,
      [&](const FinishedFrame& /*frame*/, const sensor_msgs::PointCloud2Ptr& cloud)
      { made.set_value(cloud); },
      unexpected);
  ASSERT_TRUE(maker.offer(frame));
  auto future = made.get_future();
  ASSERT_EQ(future.wait_for(DEADLINE), std::future_status::ready);
  const sensor_msgs::PointCloud2Ptr cloud = future.get();
  EXPECT_EQ(cloud->header.stamp, frame.header.stamp);

  ProductRequest request;
  request.dense_cloud = true;
  const PipelineResult whole = Pipeline(1).run(frame.light_field, frame.settings->pipeline, request);
  sensor_msgs::PointCloud2 expected;
  beginDenseCloud(frame.header, expected);
  appendDensePoints(whole.dense_cloud.data(), whole.dense_cloud.size(), 1, expected);
  EXPECT_GT(expected.width, 0U);
  EXPECT_EQ(bytesOf(*cloud), bytesOf(expected));
}

TEST(DenseCloudMaker, TakesAnotherFrameOnlyWhenItsCloudIsDone)
{
  std::promise<void> begun;
  std::promise<void> may_end;
  std::atomic<int> clouds = 0;
  std::atomic<int> niceness = 0;
  DenseCloudMaker maker(
      1,
      [&](const FinishedFrame& /*frame*/, const sensor_msgs::PointCloud2Ptr& /*cloud*/)
      {
        if (++clouds == 1)
        {
          niceness = getpriority(PRIO_PROCESS, 0);
          begun.set_value();
          may_end.get_future().wait();
        }
      },
      unexpected);
  const FinishedFrame frame = finishedFrame();
  ASSERT_TRUE(maker.offer(frame));
  ASSERT_EQ(begun.get_future().wait_for(DEADLINE), std::future_status::ready);
  EXPECT_FALSE(maker.offer(frame)) << "one is being made";
  EXPECT_TRUE(maker.queue(frame)) << "but one may wait";
  EXPECT_GT(niceness, getpriority(PRIO_PROCESS, 0)) << "it gives way to this thread";
  may_end.set_value();
  while (!maker.offer(frame))
  {
    std::this_thread::yield();
  }
  while (clouds < 3)
  {
    std::this_thread::yield();
  }
}

TEST(DenseCloudMaker, HandsOutNoCloudOfAFrameBeforeAForget)
{
  std::promise<void> begun;
  std::promise<void> may_end;
  std::vector<ros::Time> stamps;
  std::promise<void> last;
  DenseCloudMaker maker(
      1,
      [&](const FinishedFrame& frame, const sensor_msgs::PointCloud2Ptr& /*cloud*/)
      {
        stamps.push_back(frame.header.stamp);
        if (stamps.size() == 1)
        {
          begun.set_value();
          may_end.get_future().wait();
        }
        else
        {
          last.set_value();
        }
      },
      unexpected);
  ASSERT_TRUE(maker.offer(finishedFrame(1.0)));
  ASSERT_EQ(begun.get_future().wait_for(DEADLINE), std::future_status::ready);
  ASSERT_TRUE(maker.queue(finishedFrame(2.0)));
  maker.forget();
  may_end.set_value();
  ASSERT_TRUE(maker.queue(finishedFrame(3.0)));
  ASSERT_EQ(last.get_future().wait_for(DEADLINE), std::future_status::ready);
  maker.stop();
  EXPECT_EQ(stamps, (std::vector<ros::Time>{ros::Time(1.0), ros::Time(3.0)}));
}

TEST(DenseCloudMaker, TellsWhyACloudCannotBeMade)
{
  std::promise<std::string> told;
  DenseCloudMaker maker(
      1, [](const FinishedFrame& /*frame*/, const sensor_msgs::PointCloud2Ptr& /*cloud*/) { FAIL(); },
      [&](const std::string& sentence) { told.set_value(sentence); });
  FinishedFrame frame = finishedFrame();
  NodeSettings settings = *frame.settings;
  settings.pipeline.dense_cloud.voxel_size_m = -1.0F;
  frame.settings = std::make_shared<NodeSettings>(settings);
  ASSERT_TRUE(maker.offer(frame));
  auto future = told.get_future();
  ASSERT_EQ(future.wait_for(DEADLINE), std::future_status::ready);
  EXPECT_NE(future.get().find("voxel_size_m"), std::string::npos);
}

TEST(DenseCloudMaker, MakesNoneAfterItWasCancelled)
{
  DenseCloudMaker maker(
      1, [](const FinishedFrame& /*frame*/, const sensor_msgs::PointCloud2Ptr& /*cloud*/) { FAIL(); },
      unexpected);
  maker.cancel();
  EXPECT_TRUE(maker.queue(finishedFrame()));
  maker.stop();
  EXPECT_FALSE(maker.offer(finishedFrame()));
}

}  // namespace
}  // namespace light_field_depth
