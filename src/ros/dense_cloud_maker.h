#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_DENSE_CLOUD_MAKER_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_DENSE_CLOUD_MAKER_H

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/pipeline.h"
#include "ros/background_runner.h"
#include "ros/frame_queue.h"
#include "ros/message_pool.h"
#include "ros/settings.h"

namespace light_field_depth
{
/// What a dense cloud is made of.
struct FinishedFrame
{
  std_msgs::Header header;
  FrameSet set;                                  ///< whose messages hold the pixels of the light field
  LightField light_field;                        ///< that the frame is of
  std::shared_ptr<const NodeSettings> settings;  ///< of its run, which had ProductRequest::dense_cloud_later
  DisparityEstimate estimate;                    ///< that the run gave
};

/// Makes the dense clouds of finished frames, one at a time, on threads of their own that give way to all
/// others of the machine; the frames that follow are worked on meanwhile. Its pipeline is made with the first
/// cloud. Thread safe.
class DenseCloudMaker
{
public:
  /// Receives a cloud, on the thread of the maker.
  using Receiver = std::function<void(const FinishedFrame& frame, const sensor_msgs::PointCloud2Ptr& cloud)>;
  /// Receives the reason why a cloud could not be made, likewise.
  using FailureReceiver = std::function<void(const std::string& sentence)>;

  /// @param threads that work on a cloud; 0 takes one per processor
  DenseCloudMaker(int threads, Receiver on_cloud, FailureReceiver on_failure);
  ~DenseCloudMaker();
  DenseCloudMaker(const DenseCloudMaker&) = delete;
  DenseCloudMaker& operator=(const DenseCloudMaker&) = delete;

  /// Begins with a cloud and returns. @return false if another one is being made, or after cancel()
  bool offer(FinishedFrame frame);
  /// The same; waits while there are two clouds to be made before this one.
  bool queue(FinishedFrame frame);

  /// No cloud of a frame that was brought until now is handed out any more.
  void forget() { ++epoch_; }

  /// Gives up the cloud in hand soon, and makes none any more.
  void cancel();

  /// The same, and waits for it.
  void stop();

private:
  using Job = std::function<void()>;

  Job jobOf(FinishedFrame frame);
  void makeSafely(const FinishedFrame& frame, unsigned epoch);
  void make(const FinishedFrame& frame, unsigned epoch);
  Pipeline& pipeline();

  const int threads_;
  const Receiver on_cloud_;
  const FailureReceiver on_failure_;
  std::atomic<unsigned> epoch_{0};  ///< counts the calls of forget()
  MessagePool<sensor_msgs::PointCloud2> clouds_;
  std::mutex mutex_;  ///< guards what follows, but for what the pipeline does on the maker's thread
  bool cancelled_ = false;
  std::unique_ptr<Pipeline> pipeline_;
  BackgroundRunner runner_;  ///< last: its thread uses the others
};

/// Of how many points of a light field's dense cloud one is kept for the cloud to fit into a message. 1 where
/// the points are merged.
std::size_t thinningOfDenseCloud(const LightField& light_field, const DenseCloudOptions& options);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_DENSE_CLOUD_MAKER_H
