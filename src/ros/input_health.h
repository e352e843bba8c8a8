#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_INPUT_HEALTH_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_INPUT_HEALTH_H

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>

#include "light_field_depth/ros/view_array.h"
#include "ros/view_synchronizer.h"

namespace light_field_depth
{
/// From which share or latency on the diagnostics warn, and from which on they report an error. Above 1, a
/// share never does; a latency of 0 is not looked at.
struct HealthThresholds
{
  double warn_incomplete = 0.05;  ///< of the sets that were begun
  double error_incomplete = 0.5;
  double warn_replaced = 0.25;  ///< of the whole sets: replaced by newer ones before they were worked on
  double error_replaced = 0.9;
  double warn_latency_s = 0.0;  ///< median of the last frames
  double error_latency_s = 0.0;
};

enum class Health
{
  Ok,
  Warn,
  Error
};

struct HealthReport
{
  Health health = Health::Ok;
  std::string sentence;  ///< empty if all is well
};

/// What the input has been like of late: keeps the counts of some seconds. Not thread safe.
class InputHealth
{
public:
  using Time = std::chrono::steady_clock::time_point;

  /// Shares are those of so much time: long enough for some sets of an array at 1 Hz, short enough to see a
  /// camera fail.
  static constexpr std::chrono::seconds WINDOW{10};
  /// Fewer sets say nothing about shares.
  static constexpr std::uint64_t MIN_SETS = 4;

  InputHealth(ViewArray array, int queue_size, const HealthThresholds& thresholds);

  void forget() { samples_.clear(); }
  void add(Time now, const ViewSynchronizerStatistics& input, std::uint64_t replaced);

  /// What is worst, with the topic and the remedy.
  HealthReport report(double latency_median_ms) const;

private:
  struct Sample
  {
    Time time;
    ViewSynchronizerStatistics input;
    std::uint64_t replaced;
  };
  HealthReport incomplete() const;
  HealthReport replaced() const;
  HealthReport latency(double median_ms) const;
  std::string remedyFor(std::size_t view) const;

  ViewArray array_;
  int queue_size_;
  HealthThresholds thresholds_;
  std::deque<Sample> samples_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_INPUT_HEALTH_H
