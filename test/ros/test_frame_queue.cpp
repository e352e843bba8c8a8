#include "ros/frame_queue.h"

#include <thread>

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
FrameSet frame(std::int64_t id)
{
  FrameSet set;
  set.stamp_spread_ns = id;
  return set;
}

TEST(FrameQueue, KeepsTheNewest)
{
  FrameQueue queue(1);
  queue.setHeldBack(false);
  queue.push(frame(1));
  queue.push(frame(2));
  EXPECT_EQ(queue.pop()->stamp_spread_ns, 2);
  EXPECT_EQ(queue.dropped(), 1U);
  EXPECT_EQ(queue.waiting(), 0U);
}

TEST(FrameQueue, KeepsTheOrderOfSeveral)
{
  FrameQueue queue(3);
  queue.setHeldBack(false);
  for (int i = 0; i < 4; ++i)
  {
    queue.push(frame(i));
  }
  for (int i = 1; i < 4; ++i)
  {
    EXPECT_EQ(queue.pop()->stamp_spread_ns, i);
  }
  EXPECT_EQ(queue.dropped(), 1U);
}

TEST(FrameQueue, HoldsBackUntilToldOtherwise)
{
  FrameQueue queue(1);
  queue.push(frame(7));
  std::optional<FrameSet> taken;
  std::thread worker([&] { taken = queue.pop(); });
  EXPECT_TRUE(queue.isHeldBack());
  EXPECT_EQ(queue.waiting(), 1U);
  queue.setHeldBack(false);
  worker.join();
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->stamp_spread_ns, 7);
}

TEST(FrameQueue, LetsAWaitingWorkerGo)
{
  FrameQueue queue(1);
  queue.setHeldBack(false);
  std::optional<FrameSet> taken = frame(1);
  std::thread worker([&] { taken = queue.pop(); });
  queue.stop();
  worker.join();
  EXPECT_FALSE(taken);
  queue.push(frame(2));
  EXPECT_FALSE(queue.pop()) << "nothing comes out after stop()";
}

TEST(FrameQueue, CanBeEmptied)
{
  FrameQueue queue(2);
  queue.push(frame(1));
  queue.clear();
  EXPECT_EQ(queue.waiting(), 0U);
}

}  // namespace
}  // namespace light_field_depth
