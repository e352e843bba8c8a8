#include "ros/input_health.h"

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>
#include <utility>

namespace light_field_depth
{
namespace
{
constexpr double MILLISECONDS_PER_SECOND = 1000.0;
/// A view that sent fewer than this share of what the busiest view sent loses images on its way.
constexpr double AS_MANY_IMAGES = 0.9;
constexpr double NEVER = std::numeric_limits<double>::infinity();

Health healthOf(double value, double warn, double error)
{
  const Health warned = value >= warn ? Health::Warn : Health::Ok;
  return value >= error ? Health::Error : warned;
}

}  // namespace

InputHealth::InputHealth(ViewArray array, int queue_size, const HealthThresholds& thresholds)
    : array_(std::move(array)), queue_size_(queue_size), thresholds_(thresholds)
{
}

void InputHealth::add(Time now, const ViewSynchronizerStatistics& input, std::uint64_t replaced)
{
  samples_.push_back({now, input, replaced});
  while (samples_.size() > 2 && now - samples_[1].time >= WINDOW)
  {
    samples_.pop_front();
  }
}

HealthReport InputHealth::report(double latency_median_ms) const
{
  HealthReport worst;
  if (samples_.size() >= 2)
  {
    for (HealthReport& candidate :
         std::array<HealthReport, 3>{incomplete(), replaced(), latency(latency_median_ms)})
    {
      if (candidate.health > worst.health)
      {
        worst = std::move(candidate);
      }
    }
  }
  return worst;
}

HealthReport InputHealth::incomplete() const
{
  const ViewSynchronizerStatistics& before = samples_.front().input;
  const ViewSynchronizerStatistics& now = samples_.back().input;
  const std::uint64_t dropped = now.sets_dropped - before.sets_dropped;
  const std::uint64_t broken = dropped + now.sets_partial - before.sets_partial;
  const std::uint64_t all = broken + now.sets_complete - before.sets_complete;
  HealthReport report;
  if (all < MIN_SETS)
  {
    return report;
  }
  // Sets that are used without a camera that failed are no error: the node goes on.
  const auto share = [all](std::uint64_t sets)
  { return static_cast<double>(sets) / static_cast<double>(all); };
  const Health warned = healthOf(share(broken), thresholds_.warn_incomplete, NEVER);
  report.health =
      std::max(warned, healthOf(share(dropped), thresholds_.warn_incomplete, thresholds_.error_incomplete));
  const auto missing = [&](std::size_t view) { return now.views[view].missing - before.views[view].missing; };
  std::size_t worst = 0;
  for (std::size_t view = 1; view < now.views.size(); ++view)
  {
    worst = missing(view) > missing(worst) ? view : worst;
  }
  std::ostringstream text;
  text << broken << " of the last " << all << " sets lacked views; " << describe(array_.views[worst])
       << " was missing most often, " << missing(worst) << " times. " << remedyFor(worst);
  report.sentence = text.str();
  return report;
}

std::string InputHealth::remedyFor(std::size_t view) const
{
  const std::vector<ViewCounts>& before = samples_.front().input.views;
  const std::vector<ViewCounts>& now = samples_.back().input.views;
  const auto received = [&](std::size_t i) { return now[i].received - before[i].received; };
  std::uint64_t most = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    most = std::max(most, received(i));
  }
  std::ostringstream text;
  if (now[view].late > before[view].late)
  {
    text << "Its images come up to " << now[view].late_by_sets << " sets late; raise queue_size ("
         << queue_size_ << ") above that.";
  }
  else if (static_cast<double>(received(view)) < AS_MANY_IMAGES * static_cast<double>(most))
  {
    text << "It sent " << received(view) << " images, others up to " << most
         << "; look at this camera, its cable and its driver.";
  }
  else
  {
    text << "It sends as many images as the others, but with other stamps; trigger the cameras together, or "
            "set sync_tolerance.";
  }
  return text.str();
}

HealthReport InputHealth::replaced() const
{
  const std::uint64_t lost = samples_.back().replaced - samples_.front().replaced;
  const ViewSynchronizerStatistics& before = samples_.front().input;
  const ViewSynchronizerStatistics& now = samples_.back().input;
  const std::uint64_t all = now.sets_complete - before.sets_complete + now.sets_partial - before.sets_partial;
  HealthReport report;
  if (all < MIN_SETS)
  {
    return report;
  }
  report.health = healthOf(static_cast<double>(lost) / static_cast<double>(all), thresholds_.warn_replaced,
                           thresholds_.error_replaced);
  std::ostringstream text;
  text
      << lost << " of the last " << all
      << " sets were replaced by newer ones before they could be worked on; choose multiview_preset realtime "
         "or fast, fewer views, or a lower rate of the cameras.";
  report.sentence = text.str();
  return report;
}

HealthReport InputHealth::latency(double median_ms) const
{
  const auto limit = [](double seconds)
  { return seconds > 0.0 ? seconds * MILLISECONDS_PER_SECOND : std::numeric_limits<double>::infinity(); };
  HealthReport report;
  report.health = healthOf(median_ms, limit(thresholds_.warn_latency_s), limit(thresholds_.error_latency_s));
  std::ostringstream text;
  text << "The latency of the last frames is " << median_ms
       << " ms (median); choose multiview_preset realtime or fast, fewer views, or a lower rate of the "
          "cameras.";
  report.sentence = text.str();
  return report;
}

}  // namespace light_field_depth
