#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_PARAMETER_CHECK_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_PARAMETER_CHECK_H

#include <set>
#include <string>
#include <vector>

#include <ros/node_handle.h>

namespace light_field_depth
{
/// Looks at the settings of config/LightFieldDepth.cfg as they stand on the parameter server, which
/// dynamic_reconfigure would read without a word: a wrong type leaves the default, a value out of range is
/// moved to the limit.
/// @return one sentence for each value that is moved
/// @throw InputError for a wrong type and for values that cannot be used
std::vector<std::string> checkSettings(const ros::NodeHandle& private_node_handle);

/// One sentence for each private parameter that nobody reads, with the name that may have been meant.
/// Namespaces below the node's are not looked at: those of its topics belong to their transports.
/// @param read_once names of the parameters that are read once
std::vector<std::string> describeUnknownParameters(const ros::NodeHandle& private_node_handle,
                                                   const std::set<std::string>& read_once);

/// The known name that a wrong one is most likely to stand for: one that ends in it ('preset' for
/// 'multiview_preset'), or differs in at most two letters; empty if there is none.
std::string nearestName(const std::string& name, const std::set<std::string>& known);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_PARAMETER_CHECK_H
