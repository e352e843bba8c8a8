#include "light_field_depth/core/thread_pool.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <system_error>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
/// Between two stages of a frame a thread waits some microseconds; to sleep and to be woken takes longer. By
/// the clock, as on a busy machine one yield alone may take milliseconds.
constexpr std::chrono::microseconds YIELDING(50);

template <typename Condition>
void yieldUntil(const Condition& condition)
{
  const auto end = std::chrono::steady_clock::now() + YIELDING;
  while (!condition() && std::chrono::steady_clock::now() < end)
  {
    std::this_thread::yield();
  }
}

}  // namespace

ThreadPool::ThreadPool(int threads)
{
  if (threads <= 0)
  {
    threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
  workers_.reserve(static_cast<std::size_t>(threads - 1));
  try
  {
    for (int i = 1; i < threads; ++i)
    {
      workers_.emplace_back([this] { workerLoop(); });
    }
  }
  catch (const std::system_error& error)
  {
    const std::size_t started = workers_.size();
    stop();
    throw InputError("Only " + std::to_string(started) + " of " + std::to_string(threads - 1) +
                     " threads could be started (" + error.code().message() + "); ask for fewer threads.");
  }
}

ThreadPool::~ThreadPool()
{
  stop();
}

void ThreadPool::stop()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  work_ready_.notify_all();
  for (std::thread& worker : workers_)
  {
    worker.join();
  }
}

void ThreadPool::parallelFor(int begin, int end, int grain, const std::function<void(int, int)>& body)
{
  if (begin >= end)
  {
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    body_ = &body;
    begin_ = begin;
    end_ = end;
    grain_ = std::max(1, grain);
    next_chunk_ = 0;
    chunk_count_ = (end - begin + grain_ - 1) / grain_;
    failure_ = nullptr;
    if (chunk_count_ > 1)
    {
      ++calls_;
    }
  }
  if (chunk_count_ > 1)
  {
    work_ready_.notify_all();
  }
  runChunks();
  yieldUntil([this] { return chunks_running_ == 0; });
  std::unique_lock<std::mutex> lock(mutex_);
  work_done_.wait(lock, [this] { return chunks_running_ == 0 && next_chunk_ >= chunk_count_; });
  body_ = nullptr;
  if (failure_)
  {
    const std::exception_ptr failure = std::exchange(failure_, nullptr);
    lock.unlock();
    std::rethrow_exception(failure);
  }
}

void ThreadPool::workerLoop()
{
  for (unsigned seen = 0;;)
  {
    yieldUntil([&] { return calls_ != seen; });
    {
      std::unique_lock<std::mutex> lock(mutex_);
      work_ready_.wait(lock,
                       [this] { return stopping_ || (body_ != nullptr && next_chunk_ < chunk_count_); });
      if (stopping_)
      {
        return;
      }
      seen = calls_;
    }
    runChunks();
  }
}

void ThreadPool::runChunks()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (body_ != nullptr && next_chunk_ < chunk_count_)
  {
    const int chunk = next_chunk_++;
    ++chunks_running_;
    lock.unlock();
    std::exception_ptr failure;
    try
    {
      runChunk(chunk);
    }
    catch (...)
    {
      failure = std::current_exception();
    }
    lock.lock();
    --chunks_running_;
    if (failure)
    {
      failure_ = failure_ ? failure_ : failure;
      next_chunk_ = chunk_count_;
    }
  }
  if (chunks_running_ == 0)
  {
    work_done_.notify_one();
  }
}

void ThreadPool::runChunk(int chunk)
{
  if (cancellation_ != nullptr)
  {
    cancellation_->check();
  }
  const int first = begin_ + chunk * grain_;
  (*body_)(first, std::min(first + grain_, end_));
}

}  // namespace light_field_depth
