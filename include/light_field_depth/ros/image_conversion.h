#ifndef LIGHT_FIELD_DEPTH_ROS_IMAGE_CONVERSION_H
#define LIGHT_FIELD_DEPTH_ROS_IMAGE_CONVERSION_H

#include <string>

#include <sensor_msgs/Image.h>
#include <opencv2/core.hpp>

namespace light_field_depth
{
/// The image of a view, of a type that View::image allows.
///
/// mono8, 8UC1, bgr8, 8UC3, mono16, 16UC1, bgr16 and 16UC3 share the memory of the message: they are to be
/// read only, and only while the message lives. rgb8, rgb16, rgba and bgra are copied into BGR.
///
/// @param view_name begins the sentence of an error
/// @throw InputError for an empty image, another encoding, a step or an amount of data that does not fit the
///   size, or 16 bits in the other byte order
cv::Mat imageFromMessage(const sensor_msgs::Image& message, const std::string& view_name);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_ROS_IMAGE_CONVERSION_H
