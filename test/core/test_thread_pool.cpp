#include <atomic>
#include <set>

#include <gtest/gtest.h>

#include "light_field_depth/core/thread_pool.h"

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
