#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_RATE_LIMIT_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_RATE_LIMIT_H

#include <optional>

#include <ros/time.h>

namespace light_field_depth
{
/// Lets through so many frames a second at most, by their stamps.
class RateLimit
{
public:
  /// Asked for frame after frame. @param max_rate_hz 0 or less: every frame is due
  bool isDue(const ros::Time& stamp, double max_rate_hz)
  {
    // Stamps that go back are those of a bag that begins again.
    const bool too_early = max_rate_hz > 0.0 && last_ && stamp >= *last_ &&
                           (stamp - *last_).toSec() * max_rate_hz < 1.0 - TOLERANCE;
    if (!too_early)
    {
      last_ = stamp;
    }
    return !too_early;
  }

private:
  /// In parts of the period: cameras' stamps jitter.
  static constexpr double TOLERANCE = 0.1;

  std::optional<ros::Time> last_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_RATE_LIMIT_H
