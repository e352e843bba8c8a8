#include "light_field_depth/ros/yaml_parameter.h"

#include <cstddef>
#include <string>

#include <yaml-cpp/yaml.h>

namespace light_field_depth
{
namespace
{
XmlRpc::XmlRpcValue parameterOf(const YAML::Node& node)
{
  XmlRpc::XmlRpcValue value;
  if (node.IsMap())
  {
    for (const auto& entry : node)
    {
      value[entry.first.as<std::string>()] = parameterOf(entry.second);
    }
    return value;
  }
  if (node.IsSequence())
  {
    value.setSize(static_cast<int>(node.size()));
    for (std::size_t i = 0; i < node.size(); ++i)
    {
      value[static_cast<int>(i)] = parameterOf(node[i]);
    }
    return value;
  }
  int number = 0;
  return YAML::convert<int>::decode(node, number) ? XmlRpc::XmlRpcValue(number)
                                                  : XmlRpc::XmlRpcValue(node.as<std::string>());
}

}  // namespace

XmlRpc::XmlRpcValue parameterFromYaml(const std::string& text)
{
  return parameterOf(YAML::Load(text));
}

}  // namespace light_field_depth
