#include "ros/master_watch.h"

#include <chrono>
#include <utility>

#include <ros/master.h>
#include <ros/this_node.h>

namespace light_field_depth
{
namespace
{
/// One small call to the master each.
constexpr std::chrono::seconds PERIOD(2);

/// @return false if the master does not answer, or says no
bool ask(const std::string& method, XmlRpc::XmlRpcValue& answer)
{
  XmlRpc::XmlRpcValue arguments;
  arguments[0] = ros::this_node::getName();
  XmlRpc::XmlRpcValue response;
  return ros::master::execute(method, arguments, response, answer, false);
}

}  // namespace

MasterWatch::MasterWatch(std::function<void(const std::string&)> on_restart)
    : on_restart_(std::move(on_restart))
{
  hasRestarted();
  thread_ = std::thread([this] { loop(); });
}

MasterWatch::~MasterWatch()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void MasterWatch::loop()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stopped_)
  {
    lock.unlock();
    if (hasRestarted())
    {
      on_restart_("The ROS master was started anew and does not know the topics of this node; restart " +
                  ros::this_node::getName() +
                  " (respawn in a launch file does not help, as the node goes on).");
    }
    lock.lock();
    changed_.wait_for(lock, PERIOD, [this] { return stopped_; });
  }
}

bool MasterWatch::hasRestarted()
{
  XmlRpc::XmlRpcValue answer;
  if (!ask("getPid", answer) || answer.getType() != XmlRpc::XmlRpcValue::TypeInt)
  {
    return false;
  }
  const int before = std::exchange(process_, static_cast<int>(answer));
  return before != 0 && before != process_;
}

}  // namespace light_field_depth
