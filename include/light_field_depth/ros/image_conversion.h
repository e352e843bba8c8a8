#ifndef LIGHT_FIELD_DEPTH_ROS_IMAGE_CONVERSION_H
#define LIGHT_FIELD_DEPTH_ROS_IMAGE_CONVERSION_H

#include <string>

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <opencv2/core.hpp>

#include "light_field_depth/core/input_limits.h"

namespace light_field_depth
{
/// The image of a view, of a type that View::image allows.
///
/// mono8, 8UC1, bgr8, 8UC3, mono16, 16UC1, bgr16 and 16UC3 in the machine's byte order share the memory of
/// the message: they are to be read only, and only while the message lives. The rest is copied: rgb, rgba and
/// bgra of 8 and 16 bits, the four Bayer patterns of 8 and 16 bits (demosaicked bilinearly), yuv422 (UYVY)
/// and yuv422_yuy2 into BGR; 16 bits of the other byte order.
///
/// @param view_name begins the sentence of an error
/// @param mask      becomes the mask of the view (View::mask) where the image has an alpha channel: 0 where
/// alpha is 0;
///                  empty where it has none, or one that is 0 everywhere, as drivers write that do not use it
/// @param max_megapixels of the image as it comes; a larger one is refused before anything is allocated
/// @throw InputError for an empty image, another encoding, or a step or an amount of data that does not fit
/// the
///   size
cv::Mat imageFromMessage(const sensor_msgs::Image& message, const std::string& view_name,
                         cv::Mat* mask = nullptr, double max_megapixels = InputLimits().megapixels);

/// The same of a JPEG or PNG, as image_transport's compressed topics have them. A Bayer pattern that its
/// format names is demosaicked.
/// @throw InputError for data that cannot be decoded
cv::Mat imageFromMessage(const sensor_msgs::CompressedImage& message, const std::string& view_name,
                         cv::Mat* mask = nullptr, double max_megapixels = InputLimits().megapixels);

/// A mask as a message: any encoding that imageFromMessage() takes, 0 where masked. @throw InputError as it
/// does
cv::Mat maskFromMessage(const sensor_msgs::Image& message, const std::string& view_name);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_ROS_IMAGE_CONVERSION_H
