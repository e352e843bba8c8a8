#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_FRAME_QUEUE_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_FRAME_QUEUE_H

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "ros/view_image.h"

namespace light_field_depth
{
/// One whole set of images, held by pointers.
struct FrameSet
{
  std::vector<ViewImage> images;  ///< in the order of the views; none where one is missing
  std::int64_t stamp_spread_ns = 0;
  std::chrono::steady_clock::time_point arrival;  ///< of the last image
};

/// Whole sets on their way from the callbacks to the worker. When it is full, the oldest set makes room for
/// the newest. It can be held back, for the time until the calibration is known. Thread safe.
class FrameQueue
{
public:
  /// @param capacity 1: only the newest set counts
  explicit FrameQueue(std::size_t capacity) : capacity_(capacity) {}

  /// Never waits.
  void push(FrameSet set);

  /// Waits for a set; nothing once stop() has been called.
  std::optional<FrameSet> pop();

  /// While held back, sets come in but do not go out. A new queue is held back.
  void setHeldBack(bool held_back);
  bool isHeldBack() const;

  void clear();
  void stop();

  std::uint64_t dropped() const;
  std::size_t waiting() const;

private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<FrameSet> sets_;
  bool held_back_ = true;
  bool stopped_ = false;
  std::uint64_t dropped_ = 0;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_FRAME_QUEUE_H
