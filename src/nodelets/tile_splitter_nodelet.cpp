#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <image_transport/image_transport.h>
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/ros/tile_splitter.h"
#include "light_field_depth/ros/view_array.h"

namespace light_field_depth
{
/// Brings the views of one topic (a plenoptic camera's driver, a multiplexer) to the topics of an array. In
/// one manager with the depth nodelet, the views are passed on without another copy. Subscribes while
/// somebody listens.
class TileSplitterNodelet : public nodelet::Nodelet
{
private:
  static constexpr int MAX_SIDE = 100;

  /// Throws nothing: an exception would take the manager and its other nodelets along.
  void onInit() override
  {
    try
    {
      readParameters();
      transport_ = std::make_unique<image_transport::ImageTransport>(getNodeHandle());
      const std::lock_guard<std::mutex> lock(mutex_);
      const image_transport::SubscriberStatusCallback on_change =
          [this](const image_transport::SingleSubscriberPublisher&) { followListeners(); };
      for (int row = 0; row < grid_.rows; ++row)
      {
        for (int column = 0; column < grid_.columns; ++column)
        {
          publishers_.push_back(
              transport_->advertise(topicFromPattern(pattern_, {row, column}), 1, on_change, on_change));
        }
      }
    }
    catch (const std::exception& error)
    {
      NODELET_FATAL_STREAM(error.what() << " This nodelet stays loaded, but does nothing.");
    }
  }

  void readParameters()
  {
    const ros::NodeHandle& parameters = getPrivateNodeHandle();
    parameters.param("rows", grid_.rows, grid_.rows);
    parameters.param("columns", grid_.columns, grid_.columns);
    parameters.param("image_topic", pattern_, pattern_);
    if (grid_.rows < 1 || grid_.columns < 1 || grid_.rows > MAX_SIDE || grid_.columns > MAX_SIDE ||
        grid_.rows * grid_.columns < 2)
    {
      throw InputError("The parameters 'rows' and 'columns' of " + getName() + " are " +
                       std::to_string(grid_.rows) + " and " + std::to_string(grid_.columns) +
                       "; give those of the views in the image, up to " + std::to_string(MAX_SIDE) + ".");
    }
  }

  void followListeners()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    bool wanted = false;
    for (const image_transport::Publisher& publisher : publishers_)
    {
      wanted = wanted || publisher.getNumSubscribers() > 0;
    }
    if (!wanted)
    {
      subscriber_.shutdown();
    }
    else if (!subscriber_)
    {
      subscriber_ = transport_->subscribe(
          "image", 1, &TileSplitterNodelet::split, this,
          image_transport::TransportHints("raw", ros::TransportHints().tcpNoDelay(), getPrivateNodeHandle()));
    }
  }

  void split(const sensor_msgs::ImageConstPtr& image)
  {
    try
    {
      const auto columns = static_cast<std::size_t>(grid_.columns);
      for (std::size_t i = 0; i < publishers_.size(); ++i)
      {
        if (publishers_[i].getNumSubscribers() > 0)
        {
          publishers_[i].publish(
              tileOf(*image, grid_, static_cast<int>(i / columns), static_cast<int>(i % columns)));
        }
      }
    }
    catch (const InputError& error)
    {
      NODELET_ERROR_STREAM_THROTTLE(1.0, error.what());
    }
  }

  TileGrid grid_;
  std::string pattern_ = "view_{row}_{column}/image_rect_color";
  std::unique_ptr<image_transport::ImageTransport> transport_;
  std::mutex mutex_;  ///< guards the subscriber, and the publishers while they are made
  std::vector<image_transport::Publisher> publishers_;
  image_transport::Subscriber subscriber_;
};

}  // namespace light_field_depth

PLUGINLIB_EXPORT_CLASS(light_field_depth::TileSplitterNodelet, nodelet::Nodelet)
