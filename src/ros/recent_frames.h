#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_RECENT_FRAMES_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_RECENT_FRAMES_H

#include <chrono>
#include <cstddef>
#include <deque>

namespace light_field_depth
{
/// How fast a stream of frames has been of late. Not thread safe.
class RecentFrames
{
public:
  using Time = std::chrono::steady_clock::time_point;

  /// At most so many frames count, and none so much older than the newest.
  static constexpr std::size_t MAX_FRAMES = 300;
  static constexpr std::chrono::seconds LONGEST_AGE{60};

  struct Summary
  {
    std::size_t frames = 0;
    double rate_hz = 0.0;  ///< 0 with fewer than two frames
    double median_ms = 0.0;
    double p99_ms = 0.0;  ///< the least latency that 99 % of the frames do not exceed
    double longest_ms = 0.0;
  };

  void add(double latency_ms, Time published);
  Summary summary() const;

private:
  struct Frame
  {
    double latency_ms;
    Time published;
  };
  std::deque<Frame> frames_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_RECENT_FRAMES_H
