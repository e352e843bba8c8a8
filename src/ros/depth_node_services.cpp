// The services of DepthNode. None of them waits: they are served by the thread that brings the images.

#include <mutex>
#include <string>

#include <ros/console.h>

#include "light_field_depth/core/error.h"
#include "ros/depth_node_implementation.h"

namespace light_field_depth
{
void DepthNode::Implementation::advertiseServices(ros::NodeHandle node_handle)
{
  services_.push_back(node_handle.advertiseService("reset", &Implementation::reset, this));
  services_.push_back(node_handle.advertiseService("pause", &Implementation::pause, this));
  services_.push_back(node_handle.advertiseService("process_once", &Implementation::processOnce, this));
  services_.push_back(node_handle.advertiseService("save", &Implementation::save, this));
}

bool DepthNode::Implementation::reset(std_srvs::Empty::Request& /*request*/,
                                      std_srvs::Empty::Response& /*response*/)
{
  // Subscribing anew brings a CameraInfo that its publisher latched, and would not publish again.
  const std::lock_guard<std::mutex> lock(subscription_mutex_);
  if (subscribed_)
  {
    input_.unsubscribe();
  }
  input_.forget();
  queue_.setHeldBack(parameters_.use_camera_info && !input_.hasCameraInfos());
  queue_.clear();
  forget_frames_ = true;
  dense_cloud_maker_.forget();
  if (subscribed_ && !shutting_down_)
  {
    input_.subscribe();
  }
  return true;
}

bool DepthNode::Implementation::pause(std_srvs::SetBool::Request& request,
                                      std_srvs::SetBool::Response& response)
{
  paused_ = request.data != 0;
  updateSubscriptions();
  response.success = 1;
  response.message =
      paused_ ? "Paused: no set is worked on until ~pause or ~process_once says so." : "Going on.";
  return true;
}

bool DepthNode::Implementation::processOnce(std_srvs::Trigger::Request& /*request*/,
                                            std_srvs::Trigger::Response& response)
{
  ++once_;
  updateSubscriptions();
  response.success = 1;
  response.message = "The next set will be worked on.";
  return true;
}

bool DepthNode::Implementation::save(std_srvs::Trigger::Request& /*request*/,
                                     std_srvs::Trigger::Response& response)
{
  if (parameters_.save_directory.empty() || !saver_)
  {
    response.success = 0;
    response.message =
        "The parameter save_directory is empty; set it to the folder that results are to be saved below.";
    return true;
  }
  save_ = true;
  ++once_;
  FrameSet last;
  {
    const std::lock_guard<std::mutex> lock(last_set_mutex_);
    last = last_set_;
  }
  // Before the push: a listener that leaves just now clears the queue.
  updateSubscriptions();
  if (!last.images.empty())
  {
    queue_.push(std::move(last));  // the current result; where sets go on coming, it may be that of the next
  }
  response.success = 1;
  response.message = "The result will be written to a folder below " + parameters_.save_directory +
                     ", named after the stamp of its set.";
  return true;
}

void DepthNode::Implementation::saveSafely(const FrameProducts& products, const NodeSettings& settings)
{
  try
  {
    const ros::Time& stamp = products.header.stamp;
    const ViewTopics& reference = parameters_.array.views[parameters_.array.reference];
    const ResultToSave saved{
        parameters_.save_directory + "/" + std::to_string(stamp.sec) + "_" + std::to_string(stamp.nsec),
        reference.image,
        parameters_.array.views.size(),
        reference.grid,
        pipeline_.threads(),
        settings.pipeline,
        products.calibration,
        products.result};
    saver_(saved);
    ROS_INFO_STREAM("Saved the result of the set at " << stamp << " s to " << saved.folder << ".");
  }
  catch (const std::exception& error)
  {
    diagnostics_.warn(std::string("The result could not be saved: ") + error.what());
  }
}

}  // namespace light_field_depth
