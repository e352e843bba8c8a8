#ifndef LIGHT_FIELD_DEPTH_ROS_YAML_PARAMETER_H
#define LIGHT_FIELD_DEPTH_ROS_YAML_PARAMETER_H

#include <string>

#include <xmlrpcpp/XmlRpcValue.h>

namespace light_field_depth
{
/// What rosparam makes of a text in YAML, as far as the description of an array needs it: maps, lists, whole
/// numbers, and all else as text. May be called from any thread.
/// @throw YAML::Exception if it is no YAML
XmlRpc::XmlRpcValue parameterFromYaml(const std::string& text);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_ROS_YAML_PARAMETER_H
