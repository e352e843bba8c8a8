#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_PROGRESS_BAR_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_PROGRESS_BAR_H

#include <chrono>
#include <string>

namespace light_field_depth
{
/// A bar on stderr that appears once the work has taken longer than a second, on a terminal only, and
/// disappears at the end.
class ProgressBar
{
public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param fraction of the work done, 0..1
  void show(const std::string& stage, double fraction);

private:
  std::chrono::steady_clock::time_point start_;
  bool on_terminal_;
  bool shown_ = false;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_PROGRESS_BAR_H
