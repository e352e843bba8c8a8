#include "ros/background_runner.h"

#include <utility>

namespace light_field_depth
{
BackgroundRunner::BackgroundRunner(std::function<void()> prepare)
    : thread_(
          [this, prepare = std::move(prepare)]
          {
            if (prepare)
            {
              prepare();
            }
            loop();
          })
{
}

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

bool BackgroundRunner::runIfIdle(std::function<void()> job)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopped_ || running_ || waiting_)
    {
      return false;
    }
    waiting_ = std::move(job);
  }
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
    running_ = true;
    lock.unlock();
    changed_.notify_all();
    job();
    job = nullptr;  // what it held is let go without the lock
    lock.lock();
    running_ = false;
  }
}

}  // namespace light_field_depth
