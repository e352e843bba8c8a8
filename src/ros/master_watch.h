#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_MASTER_WATCH_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_MASTER_WATCH_H

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace light_field_depth
{
/// Asks the ROS master now and then whether it is still the one that this node is registered with. A master
/// that was started anew knows of no topic of the node, and roscpp does not tell it: who is connected stays
/// so, nobody new comes.
class MasterWatch
{
public:
  /// @param on_restart gets a whole sentence, once for each restart, from a thread of its own
  explicit MasterWatch(std::function<void(const std::string&)> on_restart);
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

private:
  void loop();
  /// @return whether there is a master, and it is not the one of the last call
  bool hasRestarted();

  std::function<void(const std::string&)> on_restart_;
  int process_ = 0;  ///< of the master; 0: not known yet
  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopped_ = false;
  std::thread thread_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_MASTER_WATCH_H
