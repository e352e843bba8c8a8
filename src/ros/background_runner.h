#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_BACKGROUND_RUNNER_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_BACKGROUND_RUNNER_H

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace light_field_depth
{
/// Runs jobs in their order on one thread of its own. At most one waits while another runs: who brings a
/// third waits with it. Thread safe.
class BackgroundRunner
{
public:
  /// @param prepare called first on the thread; throws nothing
  explicit BackgroundRunner(std::function<void()> prepare = nullptr);
  ~BackgroundRunner();
  BackgroundRunner(const BackgroundRunner&) = delete;
  BackgroundRunner& operator=(const BackgroundRunner&) = delete;

  /// @param job throws nothing
  /// @return false after stop(): the job will not run
  bool run(std::function<void()> job);

  /// The same if no job runs or waits. @return false otherwise, and after stop()
  bool runIfIdle(std::function<void()> job);

  /// Lets the job in hand end and forgets the one that waits; nothing runs any more afterwards.
  void stop();

private:
  void loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> waiting_;
  bool running_ = false;
  bool stopped_ = false;
  std::thread thread_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_BACKGROUND_RUNNER_H
