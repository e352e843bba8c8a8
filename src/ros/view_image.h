#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_IMAGE_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_IMAGE_H

#include <cstddef>
#include <utility>

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>

namespace light_field_depth
{
/// The image of a view as it came, raw or compressed; false when there is none.
class ViewImage
{
public:
  ViewImage() = default;
  ViewImage(sensor_msgs::ImageConstPtr raw) : raw_(std::move(raw)) {}
  ViewImage(sensor_msgs::CompressedImageConstPtr compressed) : compressed_(std::move(compressed)) {}

  explicit operator bool() const { return raw_ != nullptr || compressed_ != nullptr; }
  const sensor_msgs::ImageConstPtr& raw() const { return raw_; }
  const sensor_msgs::CompressedImageConstPtr& compressed() const { return compressed_; }

  /// @pre there is one
  std_msgs::Header header() const
  {
    return raw_ ? raw_->header : compressed_ ? compressed_->header : std_msgs::Header();
  }

  std::size_t bytes() const { return raw_ ? raw_->data.size() : compressed_ ? compressed_->data.size() : 0; }

private:
  sensor_msgs::ImageConstPtr raw_;
  sensor_msgs::CompressedImageConstPtr compressed_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_IMAGE_H
