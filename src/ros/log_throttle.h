#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_LOG_THROTTLE_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_LOG_THROTTLE_H

#include <chrono>
#include <map>
#include <string>

namespace light_field_depth
{
/// Which sentences have been logged of late, so that none is logged with every frame. Not thread safe.
class LogThrottle
{
public:
  using Time = std::chrono::steady_clock::time_point;

  /// The same sentence is not news again sooner.
  static constexpr std::chrono::seconds REPEAT_AFTER{10};

  /// @return whether the sentence should be logged now; if so, it counts as logged
  bool isNews(const std::string& sentence, Time now);

private:
  std::map<std::string, Time> logged_;  ///< none of them longer ago than REPEAT_AFTER
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_LOG_THROTTLE_H
