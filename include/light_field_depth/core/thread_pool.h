#ifndef LIGHT_FIELD_DEPTH_CORE_THREAD_POOL_H
#define LIGHT_FIELD_DEPTH_CORE_THREAD_POOL_H

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "light_field_depth/core/cancellation.h"

namespace light_field_depth
{
/// Threads that live as long as the pipeline and share out ranges of independent work.
///
/// One caller at a time: parallelFor() is not reentrant and not to be called from two threads at once.
/// Determinism: the split into chunks depends on `grain` alone, never on the number of threads, so a body
/// that writes only what belongs to its chunk gives the same result on any number of threads.
class ThreadPool
{
public:
  /// @param threads number of threads that work, the caller included; 0 takes one per processor.
  /// @throw InputError if the system does not give as many
  explicit ThreadPool(int threads = 0);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const { return static_cast<int>(workers_.size()) + 1; }  ///< the caller included

  /// Checked before every chunk; nullptr to check nothing. Set between two calls of parallelFor().
  void setCancellation(const CancellationToken* token) { cancellation_ = token; }

  /// Calls body(first, last) for consecutive chunks of at most `grain` indices that cover [begin, end), and
  /// returns when all are done.
  /// @throw the first exception that a body threw; Cancelled when the token was cancelled.
  void parallelFor(int begin, int end, int grain, const std::function<void(int, int)>& body);

private:
  void stop();
  void workerLoop();
  void runChunks();
  void runChunk(int chunk);

  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable work_ready_;
  std::condition_variable work_done_;
  const CancellationToken* cancellation_ = nullptr;

  // The work in hand, guarded by mutex_.
  const std::function<void(int, int)>* body_ = nullptr;
  int begin_ = 0;
  int end_ = 0;
  int grain_ = 1;
  int next_chunk_ = 0;
  int chunk_count_ = 0;
  std::atomic<int> chunks_running_{0};  // changed with mutex_ held
  std::atomic<unsigned> calls_{0};      // that the workers were told of, likewise
  std::exception_ptr failure_;
  bool stopping_ = false;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_THREAD_POOL_H
