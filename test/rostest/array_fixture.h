#ifndef LIGHT_FIELD_DEPTH_TEST_ROSTEST_ARRAY_FIXTURE_H
#define LIGHT_FIELD_DEPTH_TEST_ROSTEST_ARRAY_FIXTURE_H

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include "light_field_depth/ros/depth_node.h"
#include "light_field_depth/ros/view_messages.h"
#include "support/synthetic_scene.h"

namespace light_field_depth::testing
{
/// Waits until a condition holds. @param deadline later under a sanitizer
/// @return false when it did not before the deadline
bool waitFor(const std::function<bool()>& condition,
             std::chrono::milliseconds deadline = std::chrono::seconds(20));

/// A small calibrated synthetic array.
SyntheticLightField syntheticArray(std::vector<GridPosition> positions, const cv::Size& size = {96, 72});

/// The topics of an array of cameras, in the namespace of the node handle.
class ArrayPublisher
{
public:
  /// @param latch_infos whether CameraInfos are latched
  ArrayPublisher(ros::NodeHandle node_handle, const LightField& light_field, bool latch_infos = false,
                 const TopicPatterns& patterns = {});

  /// Publishes all views with one stamp.
  void publish(const ros::Time& stamp);
  /// Publishes the images (CameraInfos) of some views.
  void publishImages(const ros::Time& stamp, const std::function<bool(std::size_t view)>& wanted);
  void publishInfos(const ros::Time& stamp, const std::function<bool(std::size_t view)>& wanted);

  /// The CameraInfo of a view, to be changed before publishing.
  sensor_msgs::CameraInfo& info(std::size_t view) { return *messages_[view].camera_info; }
  sensor_msgs::Image& image(std::size_t view) { return *messages_[view].image; }

  /// How many topics, images and CameraInfos, somebody listens to.
  std::size_t topicsHeard() const;
  std::size_t topics() const { return image_publishers_.size() + info_publishers_.size(); }

private:
  std::vector<ViewMessages> messages_;
  std::vector<ros::Publisher> image_publishers_;
  std::vector<ros::Publisher> info_publishers_;
};

/// Keeps the messages of a topic.
template <class Message>
class Listener
{
public:
  Listener(ros::NodeHandle node_handle, const std::string& topic)
  {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [this](const boost::shared_ptr<const Message>& message)
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      messages_.push_back(message);
    };
    subscriber_ = node_handle.subscribe<Message>(topic, 100, callback);
  }
  ~Listener() { subscriber_.shutdown(); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  std::size_t count() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_.size();
  }

  /// The newest message; null when there is none.
  boost::shared_ptr<const Message> newest() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_.empty() ? nullptr : messages_.back();
  }

  std::vector<boost::shared_ptr<const Message>> all() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }

private:
  mutable std::mutex mutex_;
  std::vector<boost::shared_ptr<const Message>> messages_;
  ros::Subscriber subscriber_;
};

/// Whether a diagnostic status has all the words in its summary.
bool diagnosed(const Listener<diagnostic_msgs::DiagnosticArray>& listener,
               const std::vector<std::string>& words);

/// A namespace of its own for each test, and the node under test inside it. The description of the array goes
/// through the parameter server, as everywhere.
class ArrayFixture : public ::testing::Test
{
protected:
  void SetUp() override;
  void TearDown() override;

  /// Starts the node on an array: the parameter `array` lists the given views.
  /// @param fields further ones of each view by their names, as patterns
  void startNode(const LightField& light_field, const TopicPatterns& patterns = {},
                 ResultSaver saver = nullptr, const std::map<std::string, std::string>& fields = {});

  template <class Value>
  void setParameter(const std::string& name, const Value& value)
  {
    node_space_->setParam(name, value);
  }

  /// Publishes sets with rising stamps until the condition holds.
  bool publishUntil(ArrayPublisher& array, const std::function<bool()>& condition);

  ros::Time nextStamp();

  std::unique_ptr<ros::NodeHandle> array_space_;
  std::unique_ptr<ros::NodeHandle> node_space_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
  std::unique_ptr<DepthNode> node_;
  ros::Time stamp_{100.0};
};

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_ROSTEST_ARRAY_FIXTURE_H
