#ifndef LIGHT_FIELD_DEPTH_ROS_VIEW_MESSAGES_H
#define LIGHT_FIELD_DEPTH_ROS_VIEW_MESSAGES_H

#include <string>
#include <vector>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>
#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// One view on its topics.
struct ViewMessages
{
  std::string image_topic;                 ///< of `image`
  std::string camera_info_topic;           ///< of `camera_info`
  sensor_msgs::ImagePtr image;             ///< rectified
  sensor_msgs::CameraInfoPtr camera_info;  ///< with the same header
};

/// Topics of a view, {row} and {column} standing for its place.
struct TopicPatterns
{
  std::string image = "view_{row}_{column}/image_rect_color";   ///< of the image
  std::string camera_info = "view_{row}_{column}/camera_info";  ///< of its CameraInfo
};

/// The encoding of an image of the types that View::image allows.
const std::string& encodingOf(const cv::Mat& image);

/// A light field as a camera array would publish it: rectified images (mono8, bgr8, mono16, bgr16) and the
/// CameraInfo of each view.
/// @param calibration of the reference view
/// @param header of all of them; {row} and {column} in its frame_id stand for the place of the view
std::vector<ViewMessages> viewMessages(const LightField& light_field, const Calibration& calibration,
                                       const std_msgs::Header& header, const TopicPatterns& topics = {});

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_ROS_VIEW_MESSAGES_H
