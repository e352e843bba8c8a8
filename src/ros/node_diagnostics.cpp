#include "ros/node_diagnostics.h"

#include <algorithm>
#include <cstddef>

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/console.h>

namespace light_field_depth
{
namespace
{
using diagnostic_msgs::DiagnosticStatus;

/// A warning is part of the status for so long after it was last given: longer than the diagnostics' period,
/// however many good frames come meanwhile.
constexpr std::chrono::seconds WARNING_HOLDS(5);

}  // namespace

NodeDiagnostics::NodeDiagnostics(const ros::NodeHandle& node_handle,
                                 const ros::NodeHandle& private_node_handle)
    : updater_(node_handle, private_node_handle, private_node_handle.getNamespace())
{
  updater_.setHardwareID("none");
  updater_.add("input", this, &NodeDiagnostics::reportInput);
  updater_.add("frames", this, &NodeDiagnostics::reportFrames);
  updater_.add("result", this, &NodeDiagnostics::reportResult);
}

void NodeDiagnostics::framePublished(double latency_ms)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ++frames_published_;
  recent_.add(latency_ms, std::chrono::steady_clock::now());
  last_failure_.clear();
}

void NodeDiagnostics::frameFailed(const std::string& sentence)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ++frames_failed_;
  last_failure_ = sentence;
  if (isNews(sentence))
  {
    ROS_ERROR_STREAM(sentence);
  }
}

void NodeDiagnostics::warn(const std::string& sentence)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  last_warning_ = sentence;
  warned_at_ = std::chrono::steady_clock::now();
  if (isNews(sentence))
  {
    ROS_WARN_STREAM(sentence);
  }
}

void NodeDiagnostics::setDoubts(const std::vector<std::string>& sentences)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  doubts_ = sentences;
  for (const std::string& sentence : sentences)
  {
    if (isNews(sentence))
    {
      ROS_WARN_STREAM(sentence);
    }
  }
}

std::uint64_t NodeDiagnostics::framesPublished() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return frames_published_;
}

std::uint64_t NodeDiagnostics::framesFailed() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return frames_failed_;
}

RecentFrames::Summary NodeDiagnostics::recentFrames() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return recent_.summary();
}

void NodeDiagnostics::update(const ViewSynchronizerStatistics& input, std::uint64_t frames_dropped,
                             bool listening)
{
  input_ = input;
  frames_dropped_ = frames_dropped;
  listening_ = listening;
  updater_.update();
}

void NodeDiagnostics::reportInput(diagnostic_updater::DiagnosticStatusWrapper& status)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!listening_)
  {
    status.summary(DiagnosticStatus::OK, "Nobody listens.");
  }
  else if (!last_warning_.empty() && std::chrono::steady_clock::now() - warned_at_ < WARNING_HOLDS)
  {
    status.summary(DiagnosticStatus::WARN, last_warning_);
  }
  else
  {
    status.summary(DiagnosticStatus::OK, "Receiving.");
  }
  status.add("whole sets", input_.sets_complete);
  status.add("incomplete sets", input_.sets_dropped);
  status.add("jumps back in time", input_.time_jumps);
  const auto worst =
      std::max_element(input_.views.begin(), input_.views.end(),
                       [](const ViewCounts& a, const ViewCounts& b) { return a.missing < b.missing; });
  if (worst != input_.views.end() && worst->missing > 0)
  {
    status.add("most often missing, index of the view", worst - input_.views.begin());
    status.add("most often missing, times", worst->missing);
  }
}

void NodeDiagnostics::reportResult(diagnostic_updater::DiagnosticStatusWrapper& status)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  status.summary(doubts_.empty() ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                 doubts_.empty() ? "Nothing gives to doubt." : doubts_.front());
  status.add("doubts", doubts_.size());
  for (std::size_t i = 1; i < doubts_.size(); ++i)
  {
    status.add("doubt " + std::to_string(i + 1), doubts_[i]);
  }
}

void NodeDiagnostics::reportFrames(diagnostic_updater::DiagnosticStatusWrapper& status)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (last_failure_.empty())
  {
    status.summary(DiagnosticStatus::OK, "Working.");
  }
  else
  {
    status.summary(DiagnosticStatus::ERROR, last_failure_);
  }
  status.add("published", frames_published_);
  status.add("failed", frames_failed_);
  status.add("replaced by newer ones", frames_dropped_);
  const RecentFrames::Summary recent = recent_.summary();
  status.add("recent rate, Hz", recent.rate_hz);
  status.add("recent latency, median, ms", recent.median_ms);
  status.add("recent latency, 99th percentile, ms", recent.p99_ms);
  status.add("recent latency, longest, ms", recent.longest_ms);
}

}  // namespace light_field_depth
