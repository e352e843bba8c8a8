#include "ros/background_runner.h"

#include <atomic>
#include <chrono>
#include <future>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
constexpr std::chrono::seconds DEADLINE(20);

TEST(BackgroundRunner, RunsAllJobsInTheirOrder)
{
  std::vector<int> order;
  std::promise<void> done;
  BackgroundRunner runner;
  for (int i = 0; i < 100; ++i)
  {
    EXPECT_TRUE(runner.run([&order, i] { order.push_back(i); }));
  }
  runner.run([&done] { done.set_value(); });
  ASSERT_EQ(done.get_future().wait_for(DEADLINE), std::future_status::ready);
  ASSERT_EQ(order.size(), 100U);
  for (int i = 0; i < 100; ++i)
  {
    EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
  }
}

TEST(BackgroundRunner, TakesAJobForAnIdleThreadOnly)
{
  std::promise<void> begun;
  std::promise<void> may_end;
  std::atomic<bool> prepared = false;
  std::atomic<int> ran = 0;
  BackgroundRunner runner([&] { prepared = true; });
  EXPECT_TRUE(runner.runIfIdle(
      [&]
      {
        EXPECT_TRUE(prepared);
        begun.set_value();
        may_end.get_future().wait();
        ++ran;
      }));
  EXPECT_FALSE(runner.runIfIdle([&] { ++ran; })) << "one waits or runs";
  begun.get_future().wait();
  EXPECT_FALSE(runner.runIfIdle([&] { ++ran; })) << "one runs";
  may_end.set_value();
  while (!runner.runIfIdle([&] { ++ran; }))
  {
    std::this_thread::yield();
  }
  EXPECT_TRUE(runner.run([] {}));
  EXPECT_TRUE(runner.run([] {}));  // taken once the one before has begun
  EXPECT_EQ(ran, 2);
  runner.stop();
  EXPECT_FALSE(runner.runIfIdle([&] { ++ran; }));
}

TEST(BackgroundRunner, StopsWithAJobWaitingAndSomebodyWhoBringsAnother)
{
  std::promise<void> begun;
  std::promise<void> may_end;
  std::atomic<int> ran = 0;
  BackgroundRunner runner;
  runner.run(
      [&]
      {
        begun.set_value();
        may_end.get_future().wait();
        ++ran;
      });
  begun.get_future().wait();
  EXPECT_TRUE(runner.run([&] { ++ran; }));
  std::future<bool> third = std::async(std::launch::async, [&] { return runner.run([&] { ++ran; }); });
  std::thread stopper([&] { runner.stop(); });
  EXPECT_EQ(third.wait_for(DEADLINE), std::future_status::ready) << "it waits no longer";
  may_end.set_value();
  stopper.join();
  EXPECT_FALSE(third.get());
  EXPECT_EQ(ran, 1) << "the job in hand has ended, the others have not begun";
  EXPECT_FALSE(runner.run([&] { ++ran; }));
}

}  // namespace
}  // namespace light_field_depth
