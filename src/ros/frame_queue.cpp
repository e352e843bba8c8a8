#include "ros/frame_queue.h"

#include <utility>

namespace light_field_depth
{
void FrameQueue::push(FrameSet set)
{
  std::optional<FrameSet> oldest;  // let go outside the lock: freeing many images takes time
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (sets_.size() == capacity_)
    {
      oldest = std::move(sets_.front());
      sets_.pop_front();
      ++dropped_;
    }
    sets_.push_back(std::move(set));
  }
  changed_.notify_one();
}

std::optional<FrameSet> FrameQueue::pop()
{
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return stopped_ || (!held_back_ && !sets_.empty()); });
  if (stopped_)
  {
    return std::nullopt;
  }
  FrameSet set = std::move(sets_.front());
  sets_.pop_front();
  return set;
}

void FrameQueue::setHeldBack(bool held_back)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    held_back_ = held_back;
  }
  changed_.notify_one();
}

bool FrameQueue::isHeldBack() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return held_back_;
}

void FrameQueue::clear()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  sets_.clear();
}

void FrameQueue::stop()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
}

std::uint64_t FrameQueue::dropped() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return dropped_;
}

std::size_t FrameQueue::waiting() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return sets_.size();
}

}  // namespace light_field_depth
