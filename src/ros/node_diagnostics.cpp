#include "ros/node_diagnostics.h"

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
/// Of the period: a timer that comes a little early is not to skip a turn.
constexpr double EARLY = 0.9;

std::uint8_t levelOf(Health health)
{
  switch (health)
  {
    case Health::Ok:
      return DiagnosticStatus::OK;
    case Health::Warn:
      return DiagnosticStatus::WARN;
    default:
      return DiagnosticStatus::ERROR;
  }
}

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

void NodeDiagnostics::denseCloudPublished(double latency_ms)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ++dense_clouds_.published;
  dense_clouds_.last_latency_ms = latency_ms;
}

void NodeDiagnostics::denseCloudSkipped()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ++dense_clouds_.skipped;
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
  give(sentence, Health::Warn);
}

void NodeDiagnostics::error(const std::string& sentence)
{
  give(sentence, Health::Error);
}

void NodeDiagnostics::give(const std::string& sentence, Health health)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (health >= warned_health_ || now - warned_at_ >= WARNING_HOLDS)
  {
    last_warning_ = sentence;
    warned_health_ = health;
    warned_at_ = now;
  }
  if (isNews(sentence))
  {
    if (health == Health::Error)
    {
      ROS_ERROR_STREAM(sentence);
    }
    else
    {
      ROS_WARN_STREAM(sentence);
    }
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

DenseCloudCounts NodeDiagnostics::denseClouds() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return dense_clouds_;
}

void NodeDiagnostics::update(const InputState& state)
{
  state_ = state;
  const auto now = std::chrono::steady_clock::now();
  // The updater's own clock is that of ROS, and stands still while a simulation or a bag goes back.
  if (std::chrono::duration<double>(now - updated_at_).count() >= EARLY * updater_.getPeriod())
  {
    updated_at_ = now;
    updater_.force_update();
  }
}

void NodeDiagnostics::reportInput(diagnostic_updater::DiagnosticStatusWrapper& status)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool warned = !last_warning_.empty() && std::chrono::steady_clock::now() - warned_at_ < WARNING_HOLDS;
  if (!state_.listening)
  {
    status.summary(DiagnosticStatus::OK, "Nobody listens.");
  }
  else if (warned && warned_health_ >= state_.health.health)
  {
    status.summary(levelOf(warned_health_), last_warning_);
  }
  else if (state_.health.health != Health::Ok)
  {
    status.summary(levelOf(state_.health.health), state_.health.sentence);
  }
  else
  {
    status.summary(DiagnosticStatus::OK, "Receiving.");
  }
  status.add("whole sets", state_.input.sets_complete);
  status.add("sets used without all views", state_.input.sets_partial);
  status.add("incomplete sets", state_.input.sets_dropped);
  status.add("jumps back in time", state_.input.time_jumps);
  if (state_.missing > 0)
  {
    status.add("most often missing", state_.missing_topic);
    status.add("most often missing, times", state_.missing);
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
  status.add("replaced by newer ones", state_.frames_dropped);
  const RecentFrames::Summary recent = recent_.summary();
  status.add("recent rate, Hz", recent.rate_hz);
  status.add("recent latency, median, ms", recent.median_ms);
  status.add("recent latency, 99th percentile, ms", recent.p99_ms);
  status.add("recent latency, longest, ms", recent.longest_ms);
  status.add("dense clouds published", dense_clouds_.published);
  status.add("frames without one, since one was being made", dense_clouds_.skipped);
}

}  // namespace light_field_depth
