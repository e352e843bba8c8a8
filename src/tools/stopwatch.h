#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_STOPWATCH_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_STOPWATCH_H

#include <chrono>

namespace light_field_depth
{
/// Runs from its construction on.
class Stopwatch
{
public:
  double milliseconds() const
  {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_STOPWATCH_H
