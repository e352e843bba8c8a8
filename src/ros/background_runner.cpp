#include "ros/background_runner.h"

#include <utility>

namespace light_field_depth
{
BackgroundRunner::BackgroundRunner() : thread_([this] { loop(); }) {}

BackgroundRunner::~BackgroundRunner()
{
  stop();
}

bool BackgroundRunner::run(std::function<void()> job)
{
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return stopped_ || !waiting_; });
  if (stopped_)
  {
    return false;
  }
  waiting_ = std::move(job);
  changed_.notify_all();
  return true;
}

void BackgroundRunner::stop()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable())
  {
    thread_.join();
  }
}

void BackgroundRunner::loop()
{
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;)
  {
    changed_.wait(lock, [this] { return stopped_ || waiting_; });
    if (stopped_)
    {
      return;
    }
    std::function<void()> job = std::exchange(waiting_, nullptr);
    lock.unlock();
    changed_.notify_all();
    job();
    job = nullptr;  // what it held is let go without the lock
    lock.lock();
  }
}

}  // namespace light_field_depth
