#include "ros/result_watch.h"

#include "light_field_depth/evaluation/verdict.h"

namespace light_field_depth
{
namespace
{
constexpr std::chrono::seconds PERIOD(1);
/// A first frame may be dark or blurred.
constexpr int FRAMES_CHECKED_FOR_ORDER = 2;

}  // namespace

std::optional<std::vector<std::string>> ResultWatch::look(const LightField& light_field,
                                                          const DisparityEstimate& estimate, Time now)
{
  if (last_ && now - *last_ < PERIOD)
  {
    return std::nullopt;
  }
  last_ = now;
  lookAtOrder(light_field);
  std::vector<std::string> doubts = order_doubts_;
  for (std::string& sentence : judgeResult(light_field, estimate, pool_).warnings())
  {
    doubts.push_back(std::move(sentence));
  }
  return doubts;
}

void ResultWatch::lookAtOrder(const LightField& light_field)
{
  if (!check_order_ || frames_checked_ >= FRAMES_CHECKED_FOR_ORDER)
  {
    return;
  }
  ++frames_checked_;
  order_doubts_ = judgeOrder(light_field, pool_).warnings();
}

}  // namespace light_field_depth
