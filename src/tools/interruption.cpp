#include "tools/interruption.h"

#include <atomic>
#include <cstddef>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
/// The signal that ends an impatient user's wait.
constexpr int LAST_SIGNAL = 3;

std::atomic<Pipeline*> running_pipeline{nullptr};
std::atomic<int> signals{0};
static_assert(std::atomic<int>::is_always_lock_free, "the handler of a signal may not wait");

void stop(int signal)
{
  if (++signals >= LAST_SIGNAL)
  {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  if (Pipeline* const pipeline = running_pipeline.load())
  {
    pipeline->cancel();
  }
}

}  // namespace

InterruptionGuard::InterruptionGuard(Pipeline* pipeline)
{
  signals = 0;
  running_pipeline = pipeline;
  for (std::size_t i = 0; i < SIGNALS.size(); ++i)
  {
    struct sigaction action = {};
    action.sa_handler = stop;
    action.sa_flags = SA_RESTART;
    sigaction(SIGNALS[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN)
    {
      sigaction(SIGNALS[i], &action, nullptr);
    }
  }
}

InterruptionGuard::~InterruptionGuard()
{
  for (std::size_t i = 0; i < SIGNALS.size(); ++i)
  {
    sigaction(SIGNALS[i], &before_[i], nullptr);
  }
  running_pipeline = nullptr;
}

void InterruptionGuard::check() const
{
  if (signals > 0)
  {
    throw Cancelled();
  }
}

}  // namespace light_field_depth
