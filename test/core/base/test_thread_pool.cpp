#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <thread>
#include <vector>

#include <sys/resource.h>

#include <gtest/gtest.h>

#include "light_field_depth/core/thread_pool.h"
#include "support/sanitizers.h"

namespace light_field_depth
{
namespace
{
TEST(ThreadPool, CoversEveryIndexOnce)
{
  for (const int threads : {1, 2, 5})
  {
    ThreadPool pool(threads);
    std::vector<std::atomic<int>> visits(1001);
    pool.parallelFor(0, 1001, 7,
                     [&](int first, int last)
                     {
                       for (int i = first; i < last; ++i)
                       {
                         ++visits[static_cast<std::size_t>(i)];
                       }
                     });
    for (const auto& count : visits)
    {
      EXPECT_EQ(count, 1);
    }
  }
}

TEST(ThreadPool, SplitsByTheGrainAlone)
{
  for (const int threads : {1, 4})
  {
    ThreadPool pool(threads);
    std::mutex mutex;
    std::set<std::pair<int, int>> chunks;
    pool.parallelFor(3, 20, 6,
                     [&](int first, int last)
                     {
                       const std::lock_guard<std::mutex> lock(mutex);
                       chunks.emplace(first, last);
                     });
    EXPECT_EQ(chunks, (std::set<std::pair<int, int>>{{3, 9}, {9, 15}, {15, 20}}));
  }
}

TEST(ThreadPool, HandsOnTheExceptionOfABodyAndStaysUsable)
{
  ThreadPool pool(3);
  const auto fail = [](int, int) { throw InputError("bad"); };
  EXPECT_THROW(pool.parallelFor(0, 100, 1, fail), InputError);
  std::atomic<int> sum{0};
  pool.parallelFor(0, 100, 1, [&](int first, int) { sum += first; });
  EXPECT_EQ(sum, 4950);
}

/// Lets the process have no more than so much address space, for as long as it lives.
class AddressSpaceLimit
{
public:
  explicit AddressSpaceLimit(rlim_t bytes)
  {
    getrlimit(RLIMIT_AS, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_AS, &limit);
  }
  ~AddressSpaceLimit() { setrlimit(RLIMIT_AS, &before_); }
  AddressSpaceLimit(const AddressSpaceLimit&) = delete;
  AddressSpaceLimit& operator=(const AddressSpaceLimit&) = delete;

private:
  rlimit before_{};
};

TEST(ThreadPool, RefusesMoreThreadsThanTheSystemGives)
{
  if (!testing::CAN_LIMIT_ADDRESS_SPACE)
  {
    GTEST_SKIP() << "with a sanitizer";
  }
  {
    const AddressSpaceLimit room_for_few_stacks(rlim_t{1} << 30);
    EXPECT_THROW(ThreadPool(4096), InputError);
  }
  EXPECT_EQ(ThreadPool(3).threads(), 3);
}

/// Of which each takes all of a processor that it gets.
class BusyThreads
{
public:
  BusyThreads()
  {
    for (unsigned i = 0; i < 4 * std::max(1U, std::thread::hardware_concurrency()); ++i)
    {
      threads_.emplace_back(
          [this]
          {
            while (!stopped_)
            {
            }
          });
    }
  }
  ~BusyThreads()
  {
    stopped_ = true;
    for (std::thread& thread : threads_)
    {
      thread.join();
    }
  }
  BusyThreads(const BusyThreads&) = delete;
  BusyThreads& operator=(const BusyThreads&) = delete;

private:
  std::atomic<bool> stopped_{false};
  std::vector<std::thread> threads_;
};

TEST(ThreadPool, IsNotHeldUpByItsOwnWaitingOnABusyMachine)
{
  using Clock = std::chrono::steady_clock;
  constexpr int YIELDS = 10;
  const BusyThreads others;
  const auto start = Clock::now();
  for (int i = 0; i < YIELDS; ++i)
  {
    std::this_thread::yield();
  }
  const auto yields = Clock::now() - start;
  auto pool = std::make_unique<ThreadPool>(2);
  std::atomic<int> at_work{0};  // both threads, so that the pool's own waits for more now
  pool->parallelFor(0, 2, 1,
                    [&](int, int)
                    {
                      ++at_work;
                      while (at_work < 2)
                      {
                        std::this_thread::yield();
                      }
                    });
  const auto end = Clock::now();
  pool.reset();
  // Its thread has to get a processor some times, not a hundred times.
  EXPECT_LT(Clock::now() - end, 3 * yields + std::chrono::milliseconds(5));
}

TEST(ThreadPool, StopsWhenCancelled)
{
  ThreadPool pool(2);
  CancellationToken token;
  pool.setCancellation(&token);
  std::atomic<int> chunks{0};
  const auto body = [&](int, int)
  {
    if (++chunks == 3)
    {
      token.cancel();
    }
  };
  EXPECT_THROW(pool.parallelFor(0, 100000, 1, body), Cancelled);
  EXPECT_LE(chunks, 8);
}

}  // namespace
}  // namespace light_field_depth
