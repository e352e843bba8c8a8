#ifndef LIGHT_FIELD_DEPTH_ROS_VIEW_ARRAY_H
#define LIGHT_FIELD_DEPTH_ROS_VIEW_ARRAY_H

#include <cstddef>
#include <string>
#include <vector>

#include <xmlrpcpp/XmlRpcValue.h>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// Where a view comes from.
struct ViewTopics
{
  GridPosition grid;           ///< its place
  std::string image;           ///< topic
  std::string camera_info;     ///< topic; not listened to where there is a camera_info_url
  std::string mask = {};       ///< topic of its mask (View::mask), latched; empty: none
  std::string mask_file = {};  ///< an image of its mask; empty: none
  std::string camera_info_url =
      {};  ///< of its calibration file, as camera_info_manager has them; empty: none
};

/// The views of an array and their topics.
struct ViewArray
{
  std::vector<ViewTopics> views;  ///< in row-major order of their grid positions
  std::size_t reference = 0;      ///< index of the reference view
};

/// The positions of the views alone.
std::vector<GridPosition> gridOf(const ViewArray& array);

/// "View (1, 2) (view_1_2/image_rect_color)", for messages.
std::string describe(const ViewTopics& view);

/// The topic of a view: every {row} and {column} in the pattern is replaced by the number.
std::string topicFromPattern(const std::string& pattern, const GridPosition& position);

/// Reads the description of an array from the parameter `array`, one of
///
///   layout: all | cross | row | column | star     which places of the grid have a view
///   rows: 9
///   columns: 9
///   image_topic: view_{row}_{column}/image_rect_color       (the default)
///   camera_info_topic: view_{row}_{column}/camera_info      (the default)
///   camera_info_url: file:///folder/view_{row}_{column}.yaml   (none by default; instead of the topic)
///   mask_topic: view_{row}_{column}/mask                    (none by default)
///   mask_file: /folder/mask_{row}_{column}.png              (none by default)
///   reference: [4, 4]                                       (the view nearest the middle by default)
///
/// where lines go through the reference view, or
///
///   views:
///     - {row: 0, column: 0, image: left/image_rect, camera_info: left/camera_info}
///     - ...                                                 (also with camera_info_url, mask: a topic,
///     mask_file)
///   reference: [0, 0]
///
/// @throw InputError that names the field, its value and the remedy
ViewArray viewArrayFromParameter(const XmlRpc::XmlRpcValue& parameter);

/// The array that is used when nothing is said: the cross of a 9 x 9 grid.
ViewArray defaultViewArray();

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_ROS_VIEW_ARRAY_H
