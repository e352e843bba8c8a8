#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_INPUT_REPORT_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_INPUT_REPORT_H

#include <cstddef>
#include <string>
#include <vector>

#include <sensor_msgs/CameraInfo.h>

#include "light_field_depth/ros/view_array.h"
#include "ros/view_synchronizer.h"

namespace light_field_depth
{
/// Why no frame could be worked on for a while, in one or two sentences: topics that are silent, stamps that
/// do not match, CameraInfo that is missing, with the remedy. Empty when nothing is wrong.
/// @param before  the synchroniser's statistics at the beginning of the while
/// @param now     and at its end
/// @param infos   one for each view, null where none has come; empty when none is needed
/// @param seconds how long it was
/// @param queue_size the parameter in force
std::string diagnoseMissingInput(const ViewArray& array, const ViewSynchronizerStatistics& before,
                                 const ViewSynchronizerStatistics& now,
                                 const std::vector<sensor_msgs::CameraInfoConstPtr>& infos, double seconds,
                                 int queue_size);

/// What is said of views that have been silent for a while, and that the node goes on without.
/// @param silent at least one
std::string describeSilentViews(const ViewArray& array, const std::vector<std::size_t>& silent,
                                double seconds);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_INPUT_REPORT_H
