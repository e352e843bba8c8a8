#ifndef LIGHT_FIELD_DEPTH_CORE_CANCELLATION_H
#define LIGHT_FIELD_DEPTH_CORE_CANCELLATION_H

#include <atomic>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
/// A flag by which another thread stops a running pipeline. Thread safe.
class CancellationToken
{
public:
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }  ///< asks whoever checks to stop
  void reset() { cancelled_.store(false, std::memory_order_relaxed); }  ///< as if nobody had asked
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }  ///< whether somebody asked

  /// @throw Cancelled after cancel().
  void check() const
  {
    if (cancelled())
    {
      throw Cancelled();
    }
  }

private:
  std::atomic<bool> cancelled_{false};
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_CANCELLATION_H
