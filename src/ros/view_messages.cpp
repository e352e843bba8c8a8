#include "light_field_depth/ros/view_messages.h"

#include <utility>

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>

#include "light_field_depth/ros/calibration_from_camera_info.h"
#include "light_field_depth/ros/view_array.h"

namespace light_field_depth
{
const std::string& encodingOf(const cv::Mat& image)
{
  namespace encodings = sensor_msgs::image_encodings;
  switch (image.type())
  {
    case CV_8UC1:
      return encodings::MONO8;
    case CV_16UC1:
      return encodings::MONO16;
    case CV_16UC3:
      return encodings::BGR16;
    default:
      return encodings::BGR8;
  }
}

std::vector<ViewMessages> viewMessages(const LightField& light_field, const Calibration& calibration,
                                       const std_msgs::Header& header, const TopicPatterns& topics)
{
  std::vector<ViewMessages> messages;
  for (const View& view : light_field.views)
  {
    std_msgs::Header own_header = header;
    own_header.frame_id = topicFromPattern(header.frame_id, view.grid);
    ViewMessages message;
    message.image_topic = topicFromPattern(topics.image, view.grid);
    message.camera_info_topic = topicFromPattern(topics.camera_info, view.grid);
    message.image = cv_bridge::CvImage(own_header, encodingOf(view.image), view.image).toImageMsg();
    message.camera_info =
        boost::make_shared<sensor_msgs::CameraInfo>(cameraInfoFor(view, calibration, light_field.size()));
    message.camera_info->header = own_header;
    messages.push_back(std::move(message));
  }
  return messages;
}

}  // namespace light_field_depth
