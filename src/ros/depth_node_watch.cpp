// What DepthNode says of its input while it waits for it.

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "ros/depth_node_implementation.h"
#include "ros/input_report.h"

namespace light_field_depth
{
void DepthNode::Implementation::watch(const ros::SteadyTimerEvent& /*event*/)
{
  updateSubscriptions();  // a set that was asked for once may have been worked on
  bool listening = false;
  {
    const std::lock_guard<std::mutex> lock(subscription_mutex_);
    listening = subscribed_;
  }
  const ViewSynchronizerStatistics heard = input_.statistics();
  watchInput(listening, heard);
  reportHealth(listening, heard);
}

void DepthNode::Implementation::watchInput(bool listening, const ViewSynchronizerStatistics& heard)
{
  if (listening)
  {
    const std::vector<std::size_t> silent = input_.giveUpSilentViews(parameters_.patience_s);
    if (!silent.empty())
    {
      diagnostics_.warn(describeSilentViews(parameters_.array, silent, parameters_.patience_s));
    }
  }
  const auto now = std::chrono::steady_clock::now();
  const bool waiting_for_calibration =
      parameters_.use_camera_info && queue_.waiting() > 0 && queue_.isHeldBack();
  const bool got_set =
      heard.sets_complete + heard.sets_partial != heard_before_.sets_complete + heard_before_.sets_partial;
  if (!listening || (got_set && !waiting_for_calibration) || heard_before_.views.empty())
  {
    silent_since_ = now;
    heard_before_ = heard;
  }
  const double silent_s = std::chrono::duration<double>(now - silent_since_).count();
  if (silent_s >= parameters_.patience_s)
  {
    const auto infos =
        parameters_.use_camera_info ? input_.cameraInfos() : std::vector<sensor_msgs::CameraInfoConstPtr>();
    const std::string sentence = diagnoseMissingInput(parameters_.array, heard_before_, heard, infos,
                                                      parameters_.patience_s, parameters_.queue_size);
    if (!sentence.empty())
    {
      diagnostics_.error(sentence);
    }
    silent_since_ = now;
    heard_before_ = heard;
  }
}

void DepthNode::Implementation::reportHealth(bool listening, const ViewSynchronizerStatistics& heard)
{
  InputState state;
  state.input = heard;
  state.frames_dropped = queue_.dropped();
  state.listening = listening;
  if (listening)
  {
    health_.add(std::chrono::steady_clock::now(), heard, state.frames_dropped);
    state.health = health_.report(diagnostics_.recentFrames().median_ms);
  }
  else
  {
    health_.forget();
  }
  for (std::size_t view = 0; view < heard.views.size(); ++view)
  {
    if (heard.views[view].missing > state.missing)
    {
      state.missing = heard.views[view].missing;
      state.missing_topic = describe(parameters_.array.views[view]);
    }
  }
  diagnostics_.update(state);
}

}  // namespace light_field_depth
