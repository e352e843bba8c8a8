#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_FRAMES_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_FRAMES_H

#include <string>
#include <vector>

#include <geometry_msgs/TransformStamped.h>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// Where the views of a calibrated light field stand, as transforms from the frame of the reference view. A
/// view whose images have a frame of their own keeps its name; the others are named after the reference's
/// frame and their place, "FRAME_view_ROW_COLUMN". The reference view itself has none.
/// @param image_frames one for each view of the light field
/// @pre light_field.calibration is set
std::vector<geometry_msgs::TransformStamped> viewFrames(const LightField& light_field,
                                                        const std::vector<std::string>& image_frames,
                                                        const std::string& reference_frame);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_FRAMES_H
