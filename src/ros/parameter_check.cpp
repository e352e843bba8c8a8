#include "ros/parameter_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <sstream>

#include <ros/param.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <boost/any.hpp>

#include "light_field_depth/LightFieldDepthConfig.h"
#include "light_field_depth/core/error.h"
#include "ros/settings.h"

namespace light_field_depth
{
namespace
{
using XmlRpc::XmlRpcValue;

/// More letters changed, added or left out make another word.
constexpr std::size_t MAX_SLIPS = 2;

/// How many letters have to be changed, added or left out to make one word of the other.
std::size_t editDistance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

const char* wantedType(const std::string& type)
{
  if (type == "bool")
  {
    return "true or false";
  }
  if (type == "str")
  {
    return "a text; put it in quotes";
  }
  return type == "int" ? "a whole number" : "a number";
}

bool hasType(const XmlRpcValue& value, const std::string& type)
{
  switch (value.getType())
  {
    case XmlRpcValue::TypeBoolean:
      return type == "bool";
    case XmlRpcValue::TypeInt:
      return type == "int" || type == "double";
    case XmlRpcValue::TypeDouble:
      return type == "double";
    default:
      return value.getType() == XmlRpcValue::TypeString && type == "str";
  }
}

std::string textOf(const boost::any& value)
{
  std::ostringstream text;
  if (const auto* const number = boost::any_cast<double>(&value))
  {
    text << *number;
  }
  else if (const auto* const integer = boost::any_cast<int>(&value))
  {
    text << *integer;
  }
  return text.str();
}

}  // namespace

std::vector<std::string> checkSettings(const ros::NodeHandle& private_node_handle)
{
  for (const auto& description : LightFieldDepthConfig::__getParamDescriptions__())
  {
    XmlRpcValue value;
    if (private_node_handle.getParam(description->name, value) && !hasType(value, description->type))
    {
      throw InputError("The parameter '" + private_node_handle.resolveName(description->name) + "' is not " +
                       wantedType(description->type) + ".");
    }
  }
  LightFieldDepthConfig given = LightFieldDepthConfig::__getDefault__();
  given.__fromServer__(private_node_handle);
  LightFieldDepthConfig used = given;
  used.__clamp__();
  std::vector<std::string> sentences;
  for (const auto& description : LightFieldDepthConfig::__getParamDescriptions__())
  {
    boost::any before;
    boost::any after;
    description->getValue(given, before);
    description->getValue(used, after);
    if (textOf(before) != textOf(after))
    {
      sentences.push_back("The parameter '" + description->name + "' is " + textOf(before) +
                          ", beyond its limit; " + textOf(after) + " is used.");
    }
  }
  settingsFrom(used);  // throws what cannot be used
  return sentences;
}

std::string nearestName(const std::string& name, const std::set<std::string>& known)
{
  std::string nearest;
  std::size_t distance = MAX_SLIPS + 1;
  for (const std::string& candidate : known)
  {
    const bool is_end =
        candidate.size() > name.size() + 1 &&
        candidate.compare(candidate.size() - name.size() - 1, std::string::npos, "_" + name) == 0;
    const std::size_t slips = is_end ? 0 : editDistance(name, candidate);
    if (slips < distance && slips < candidate.size())
    {
      nearest = candidate;
      distance = slips;
    }
  }
  return nearest;
}

std::vector<std::string> describeUnknownParameters(const ros::NodeHandle& private_node_handle,
                                                   const std::set<std::string>& read_once)
{
  std::set<std::string> known = read_once;
  for (const auto& description : LightFieldDepthConfig::__getParamDescriptions__())
  {
    known.insert(description->name);
  }
  std::vector<std::string> sentences;
  XmlRpcValue all;
  if (!ros::param::get(private_node_handle.getNamespace(), all) || all.getType() != XmlRpcValue::TypeStruct)
  {
    return sentences;
  }
  for (auto& [name, value] : all)
  {
    if (known.count(name) == 0 && value.getType() != XmlRpcValue::TypeStruct)
    {
      const std::string nearest = nearestName(name, known);
      sentences.push_back("Nobody reads the parameter '" + private_node_handle.resolveName(name) + "'; " +
                          (nearest.empty() ? "remove it, or look its name up in the README."
                                           : "'" + nearest + "' may have been meant."));
    }
  }
  return sentences;
}

}  // namespace light_field_depth
