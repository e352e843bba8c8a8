#ifndef LIGHT_FIELD_DEPTH_SRC_TOOLS_INTERRUPTION_H
#define LIGHT_FIELD_DEPTH_SRC_TOOLS_INTERRUPTION_H

#include <array>
#include <csignal>

#include "light_field_depth/core/pipeline.h"

namespace light_field_depth
{
/// While it lives, SIGINT, SIGTERM and SIGHUP end the work in order: the computation is cancelled, and what
/// was being written is removed or finished. The third signal ends the program at once. Signals that were
/// ignored before (nohup) stay so. One at a time.
class InterruptionGuard
{
public:
  /// @param pipeline that is cancelled, if any
  explicit InterruptionGuard(Pipeline* pipeline = nullptr);
  ~InterruptionGuard();
  InterruptionGuard(const InterruptionGuard&) = delete;
  InterruptionGuard& operator=(const InterruptionGuard&) = delete;

  /// @throw Cancelled after one of the signals
  void check() const;

private:
  static constexpr std::array<int, 3> SIGNALS = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, SIGNALS.size()> before_{};
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_TOOLS_INTERRUPTION_H
