#include "light_field_depth/ros/distributor_node.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <ros/console.h>
#include <ros/steady_timer.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <stereo_msgs/DisparityImage.h>

#include "light_field_depth/LightFieldDepthStats.h"
#include "light_field_depth/core/error.h"
#include "ros/node_parameters.h"
#include "ros/set_ledger.h"
#include "ros/view_image.h"
#include "ros/view_input.h"

namespace light_field_depth
{
namespace
{
const ros::WallDuration WATCH_PERIOD(0.2);
constexpr std::uint32_t QUEUE_SIZE = 5;
const std::string STATS = "stats";
/// The name of the depth node in the namespace of each worker.
const std::string WORKER_NODE = "light_field_depth";
constexpr double WARNING_PERIOD_S = 5.0;
/// After the stats of a set, which a worker publishes last, its other results are on their way for no longer
/// than this.
constexpr std::chrono::seconds GRACE(1);

/// A list of namespaces, or how many there are: worker_0, worker_1, ...
std::vector<std::string> readWorkers(const ros::NodeHandle& node_handle)
{
  constexpr int MAX_WORKERS = 1000;
  std::vector<std::string> workers;
  int count = 0;
  if (node_handle.getParam("workers", count) && count <= MAX_WORKERS)
  {
    for (int worker = 0; worker < count; ++worker)
    {
      workers.push_back("worker_" + std::to_string(worker));
    }
  }
  else
  {
    node_handle.getParam("workers", workers);
  }
  if (workers.empty() || std::set<std::string>(workers.begin(), workers.end()).size() != workers.size())
  {
    throw InputError(
        "The parameter '" + node_handle.resolveName("workers") +
        "' is neither a number of workers nor a list of different namespaces; write 'workers: 2' or "
        "'workers: [worker_0, worker_1]'.");
  }
  return workers;
}

NodeParameters defaults()
{
  NodeParameters parameters;
  parameters.use_camera_info = false;  // they are only passed on
  parameters.patience_s = 10.0;        // of an answer, which takes longer than a set
  return parameters;
}

std::int64_t nanoseconds(const ros::Time& stamp)
{
  return static_cast<std::int64_t>(stamp.toNSec());
}

}  // namespace

class DistributorNode::Implementation
{
public:
  Implementation(const ros::NodeHandle& node_handle, const ros::NodeHandle& private_node_handle)
      : node_handle_(node_handle), private_node_handle_(private_node_handle),
        parameters_(readSetParameters(private_node_handle, defaults())),
        workers_(readWorkers(private_node_handle)), ledger_(workers_.size()),
        waiting_(queueCapacity(parameters_)),
        input_(
            node_handle, private_node_handle, parameters_, [this](FrameSet set) { take(std::move(set)); },
            [] {}, [](const std::string& sentence) { ROS_WARN_STREAM_THROTTLE(WARNING_PERIOD_S, sentence); })
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const std::string& worker : workers_)
    {
      views_.emplace_back();
      for (const ViewTopics& view : parameters_.array.views)
      {
        views_.back().push_back(advertiseView(inWorker(worker, view.image)));
      }
    }
    forwardLatchedTopics();
    addResult<stereo_msgs::DisparityImage>("disparity");
    addResult<sensor_msgs::Image>("disparity_color");
    addResult<sensor_msgs::Image>("depth");
    addResult<sensor_msgs::Image>("depth_mm");
    addResult<sensor_msgs::Image>("confidence");
    addResult<sensor_msgs::Image>("confidence_mono8");
    addResult<sensor_msgs::PointCloud2>("points2");
    addResult<sensor_msgs::PointCloud2>("points_dense");
    addResult<sensor_msgs::CameraInfo>("camera_info");
    addResult<sensor_msgs::Image>("left/image_rect_color");
    addResult<sensor_msgs::CameraInfo>("left/camera_info");
    addResult<sensor_msgs::CameraInfo>("right/camera_info");
    addResult<LightFieldDepthStats>(STATS);
    timer_ = private_node_handle_.createSteadyTimer(WATCH_PERIOD, &Implementation::watch, this);
  }

  ~Implementation()
  {
    timer_.stop();
    input_.unsubscribe();
    for (ros::Subscriber& subscriber : latched_subscribers_)
    {
      subscriber.shutdown();
    }
    for (Result& result : results_)
    {
      for (ros::Subscriber& subscriber : result.subscribers)
      {
        subscriber.shutdown();
      }
      result.publisher.shutdown();
    }
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

private:
  /// A topic of results: this node's, and those of the workers while somebody listens.
  struct Result
  {
    std::string topic;
    ros::Publisher publisher;
    std::function<ros::Subscriber(std::size_t worker)> subscribe;
    std::vector<ros::Subscriber> subscribers;
  };

  static std::string inWorker(const std::string& worker, const std::string& topic)
  {
    return worker + (topic.front() == '/' ? "" : "/") + topic;
  }

  /// As the images come: compressed ones are not decoded on the way.
  ros::Publisher advertiseView(const std::string& topic)
  {
    return parameters_.image_transport == COMPRESSED_TRANSPORT
               ? node_handle_.advertise<sensor_msgs::CompressedImage>(topic + "/" + COMPRESSED_TRANSPORT,
                                                                      QUEUE_SIZE)
               : node_handle_.advertise<sensor_msgs::Image>(topic, QUEUE_SIZE);
  }

  /// What belongs to no single set goes to all workers, latched for those that come later: calibration and
  /// masks. What is in the images or in files, alpha and mask_file, the workers have themselves.
  void forwardLatchedTopics()
  {
    for (const ViewTopics& view : parameters_.array.views)
    {
      forwardLatched<sensor_msgs::CameraInfo>(view.camera_info);
      if (!view.mask.empty())
      {
        forwardLatched<sensor_msgs::Image>(view.mask);
      }
    }
  }

  template <class Message>
  void forwardLatched(const std::string& topic)
  {
    std::vector<ros::Publisher> publishers;
    for (const std::string& worker : workers_)
    {
      publishers.push_back(node_handle_.advertise<Message>(inWorker(worker, topic), 1, true));
    }
    const boost::function<void(const boost::shared_ptr<const Message>&)> on_message =
        [publishers](const boost::shared_ptr<const Message>& message)
    {
      for (const ros::Publisher& publisher : publishers)
      {
        publisher.publish(message);
      }
    };
    latched_subscribers_.push_back(node_handle_.subscribe<Message>(topic, 1, on_message));
  }

  template <class Message>
  void addResult(const std::string& topic)
  {
    Result result;
    result.topic = topic;
    result.publisher = private_node_handle_.advertise<Message>(topic, QUEUE_SIZE);
    const ros::Publisher publisher = result.publisher;
    result.subscribe = [this, topic, publisher](std::size_t worker)
    {
      const boost::function<void(const boost::shared_ptr<const Message>&)> on_result =
          [this, topic, publisher, worker](const boost::shared_ptr<const Message>& message)
      {
        comeBack(worker, nanoseconds(message->header.stamp), topic,
                 [publisher, message] { publisher.publish(message); });
      };
      return node_handle_.subscribe<Message>(inWorker(workers_[worker], WORKER_NODE + "/" + topic),
                                             QUEUE_SIZE, on_result, ros::VoidPtr(),
                                             ros::TransportHints().tcpNoDelay());
    };
    results_.push_back(std::move(result));
  }

  /// A worker is alive while it listens to all views: without one of them it would wait for the set's rest.
  std::vector<bool> alive() const
  {
    std::vector<bool> alive;
    for (const std::vector<ros::Publisher>& views : views_)
    {
      alive.push_back(std::all_of(views.begin(), views.end(),
                                  [](const ros::Publisher& view) { return view.getNumSubscribers() > 0; }));
    }
    return alive;
  }

  void take(FrameSet set)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (sets_.size() >= waiting_)
    {
      sets_.erase(sets_.begin());
      ++replaced_;
      ROS_WARN_STREAM_THROTTLE(
          WARNING_PERIOD_S,
          "The workers are busy: " << replaced_
                                   << " sets so far were left out for newer ones; add workers, or take "
                                      "a faster multiview_preset.");
    }
    sets_.push_back(std::move(set));
    giveOut();
  }

  void comeBack(std::size_t worker, std::int64_t stamp_ns, const std::string& topic,
                SetLedger::Publication publication)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ledger_.add(worker, stamp_ns, topic, std::move(publication));
    if (topic == STATS)
    {
      ledger_.finish(worker, stamp_ns, GRACE, std::chrono::steady_clock::now());
    }
    publishReady();
    giveOut();
  }

  /// @pre mutex_ is held: results of one set are published together, and in order
  void publishReady()
  {
    for (const SetLedger::Publication& publish : ledger_.takeReady())
    {
      publish();
    }
  }

  /// @pre mutex_ is held
  void giveOut()
  {
    while (!sets_.empty())
    {
      const std::optional<std::size_t> worker = ledger_.idleWorker(alive());
      if (!worker)
      {
        return;
      }
      const FrameSet set = std::move(sets_.front());
      sets_.erase(sets_.begin());
      const ros::Time stamp = set.images[parameters_.array.reference].header().stamp;
      ledger_.give(*worker, nanoseconds(stamp), wantedTopics(), std::chrono::steady_clock::now());
      for (std::size_t view = 0; view < set.images.size(); ++view)
      {
        const ViewImage& image = set.images[view];
        if (image.compressed() != nullptr)
        {
          views_[*worker][view].publish(image.compressed());
        }
        else if (image.raw() != nullptr)
        {
          views_[*worker][view].publish(image.raw());
        }
      }
    }
  }

  std::set<std::string> wantedTopics() const
  {
    std::set<std::string> topics;
    for (const Result& result : results_)
    {
      if (!result.subscribers.empty())
      {
        topics.insert(result.topic);
      }
    }
    return topics;
  }

  void watch(const ros::SteadyTimerEvent& /*event*/)
  {
    // Not under the lock: leaving the topics waits for callbacks that may want it.
    if (hasListeners())
    {
      input_.subscribe();
    }
    else
    {
      input_.unsubscribe();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    followListeners();
    const std::vector<bool> alive_now = alive();
    for (const SetLedger::Lost& lost :
         ledger_.giveUp(alive_now, std::chrono::duration<double>(parameters_.patience_s),
                        std::chrono::steady_clock::now()))
    {
      ROS_WARN_STREAM("The worker '" << workers_[lost.worker] << "' "
                                     << (alive_now[lost.worker] ? "has not answered" : "is gone")
                                     << "; the set at "
                                     << ros::Time().fromNSec(static_cast<std::uint64_t>(lost.stamp_ns))
                                     << " s is lost. It is used again when it is back.");
    }
    publishReady();
    giveOut();
    if (!sets_.empty() && std::find(alive_now.begin(), alive_now.end(), true) == alive_now.end())
    {
      ROS_WARN_STREAM_THROTTLE(WARNING_PERIOD_S, "No worker listens to all views, as '"
                                                     << views_.front()[parameters_.array.reference].getTopic()
                                                     << "'; start the workers.");
    }
  }

  bool hasListeners() const
  {
    return std::any_of(results_.begin(), results_.end(),
                       [](const Result& result) { return result.publisher.getNumSubscribers() > 0; });
  }

  /// Subscribes to what somebody listens to, at every worker; the stats come with anything. @pre mutex_ is
  /// held
  void followListeners()
  {
    const bool any = hasListeners();
    for (Result& result : results_)
    {
      const bool wanted = result.publisher.getNumSubscribers() > 0 || (any && result.topic == STATS);
      if (wanted && result.subscribers.empty())
      {
        for (std::size_t worker = 0; worker < workers_.size(); ++worker)
        {
          result.subscribers.push_back(result.subscribe(worker));
        }
      }
      else if (!wanted)
      {
        result.subscribers.clear();
      }
    }
    if (!any)
    {
      sets_.clear();
    }
  }

  ros::NodeHandle node_handle_;
  ros::NodeHandle private_node_handle_;
  const NodeParameters parameters_;
  const std::vector<std::string> workers_;

  std::vector<ros::Subscriber> latched_subscribers_;

  std::mutex mutex_;                                ///< guards what follows, but for input_
  std::vector<std::vector<ros::Publisher>> views_;  ///< of each worker
  std::vector<Result> results_;
  SetLedger ledger_;
  std::size_t waiting_;         ///< sets that may wait
  std::vector<FrameSet> sets_;  ///< that wait for a worker
  std::uint64_t replaced_ = 0;
  ViewInput input_;
  ros::SteadyTimer timer_;
};

DistributorNode::DistributorNode(const ros::NodeHandle& node_handle,
                                 const ros::NodeHandle& private_node_handle)
    : implementation_(std::make_unique<Implementation>(node_handle, private_node_handle))
{
}

DistributorNode::~DistributorNode() = default;

}  // namespace light_field_depth
