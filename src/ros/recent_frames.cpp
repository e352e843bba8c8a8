#include "ros/recent_frames.h"

#include <algorithm>
#include <vector>

namespace light_field_depth
{
namespace
{
/// By rank: the least of the values that this share of them does not exceed.
/// @param percent 1..100 @pre sorted is not empty
double percentile(const std::vector<double>& sorted, std::size_t percent)
{
  const std::size_t rank = (percent * sorted.size() + 99) / 100;
  return sorted[rank - 1];
}

}  // namespace

void RecentFrames::add(double latency_ms, Time published)
{
  frames_.push_back({latency_ms, published});
  while (frames_.size() > MAX_FRAMES || published - frames_.front().published > LONGEST_AGE)
  {
    frames_.pop_front();
  }
}

RecentFrames::Summary RecentFrames::summary() const
{
  Summary summary;
  summary.frames = frames_.size();
  if (frames_.empty())
  {
    return summary;
  }
  std::vector<double> latencies_ms;
  for (const Frame& frame : frames_)
  {
    latencies_ms.push_back(frame.latency_ms);
  }
  std::sort(latencies_ms.begin(), latencies_ms.end());
  summary.median_ms = percentile(latencies_ms, 50);
  summary.p99_ms = percentile(latencies_ms, 99);
  summary.longest_ms = latencies_ms.back();
  const std::chrono::duration<double> seconds = frames_.back().published - frames_.front().published;
  if (seconds.count() > 0.0)
  {
    summary.rate_hz = static_cast<double>(frames_.size() - 1) / seconds.count();
  }
  return summary;
}

}  // namespace light_field_depth
