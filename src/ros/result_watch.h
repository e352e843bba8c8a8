#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_RESULT_WATCH_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_RESULT_WATCH_H

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// Asks now and then whether the results can be right: of the first frames, whether the views stand where the
/// array claims; of a frame a second, whether the views agree. Used by one thread.
class ResultWatch
{
public:
  using Time = std::chrono::steady_clock::time_point;

  /// @param check_order false: the places of the views are not questioned
  explicit ResultWatch(bool check_order) : check_order_(check_order) {}

  /// @param now not before the last call's
  /// @return the sentences of all doubts; nothing if it was not time to look
  std::optional<std::vector<std::string>> look(const LightField& light_field,
                                               const DisparityEstimate& estimate, Time now);

private:
  void lookAtOrder(const LightField& light_field);

  bool check_order_;
  int frames_checked_ = 0;
  std::vector<std::string> order_doubts_;
  std::optional<Time> last_;
  ThreadPool pool_{1};
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_RESULT_WATCH_H
