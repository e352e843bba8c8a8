#include "ros/settings.h"

#include <ios>
#include <map>
#include <sstream>
#include <type_traits>
#include <utility>

#include <ros/console.h>
#include <boost/any.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/options_visitor.h"

namespace light_field_depth
{
namespace
{
/// The value of a setting by its name; empty when config/LightFieldDepth.cfg does not have it.
boost::any valueOf(const LightFieldDepthConfig& config, const std::string& name)
{
  boost::any value;
  for (const auto& description : LightFieldDepthConfig::__getParamDescriptions__())
  {
    if (description->name == name)
    {
      description->getValue(config, value);
    }
  }
  return value;
}

/// dynamic_reconfigure knows bool, int, double and text; the options also have float and enumerations.
template <class Field>
void assign(const boost::any& value, Field& field)
{
  if constexpr (std::is_floating_point_v<Field>)
  {
    field = static_cast<Field>(boost::any_cast<double>(value));
  }
  else if constexpr (std::is_enum_v<Field>)
  {
    fromString(boost::any_cast<std::string>(value), field);
  }
  else
  {
    field = boost::any_cast<Field>(value);
  }
}

/// A value of a setting as text.
template <class Field>
std::string textOf(const Field& field)
{
  if constexpr (std::is_enum_v<Field>)
  {
    return toString(field);
  }
  else
  {
    std::ostringstream text;
    text << std::boolalpha << field;
    return text.str();
  }
}

std::map<std::string, std::string> numbersOf(const PipelineOptions& options)
{
  PipelineOptions numbers = options;
  numbers.multiview = withPresetNumbers(options.multiview);
  std::map<std::string, std::string> texts;
  visitOptions(numbers,
               [&texts](const std::string& name, const auto& field) { texts[name] = textOf(field); });
  return texts;
}

}  // namespace

std::string describePresetChange(const PipelineOptions& before, const PipelineOptions& after)
{
  if (before.multiview.preset == after.multiview.preset)
  {
    return "";
  }
  const std::map<std::string, std::string> old = numbersOf(before);
  std::string changes;
  for (const auto& [name, value] : numbersOf(after))
  {
    if (name != "multiview_preset" && old.at(name) != value)
    {
      changes.append(changes.empty() ? ": " : ", ").append(name).append(" ").append(value);
      changes.append(" (was ").append(old.at(name)).append(")");
    }
  }
  return "The preset is now " + toString(after.multiview.preset) + changes + ".";
}

NodeSettings settingsFrom(const LightFieldDepthConfig& config)
{
  NodeSettings settings;
  settings.dense_cloud = config.dense_cloud;
  settings.dense_cloud_max_rate_hz = config.dense_cloud_max_rate_hz;
  PipelineOptions& pipeline = settings.pipeline;
  visitOptions(pipeline,
               [&config](const std::string& name, auto& field)
               {
                 const boost::any value = valueOf(config, name);
                 if (!value.empty())
                 {
                   assign(value, field);
                 }
               });
  if (!config.disparity_range_auto)
  {
    pipeline.disparity_range =
        DisparityRange{static_cast<float>(config.disparity_min), static_cast<float>(config.disparity_max)};
  }

  std::string text;
  for (const std::string& problem : validate(pipeline))
  {
    text += (text.empty() ? "" : " ") + problem;
  }
  if (!text.empty())
  {
    throw InputError(text);
  }
  return settings;
}

SettingsServer::SettingsServer(const ros::NodeHandle& private_node_handle, RefusalCallback on_refusal)
    : on_refusal_(std::move(on_refusal)),
      settings_(std::make_shared<NodeSettings>(settingsFrom(LightFieldDepthConfig::__getDefault__()))),
      config_(LightFieldDepthConfig::__getDefault__()), server_(server_mutex_, private_node_handle)
{
  server_.setCallback([this](LightFieldDepthConfig& config, std::uint32_t /*level*/)
                      { reconfigure(config); });
}

std::shared_ptr<const NodeSettings> SettingsServer::snapshot() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return settings_;
}

void SettingsServer::reconfigure(LightFieldDepthConfig& config)
{
  try
  {
    auto settings = std::make_shared<const NodeSettings>(settingsFrom(config));
    config_ = config;
    const std::string change = describePresetChange(snapshot()->pipeline, settings->pipeline);
    if (!change.empty())
    {
      ROS_INFO_STREAM(change);
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    settings_ = std::move(settings);
  }
  catch (const InputError& error)
  {
    config = config_;
    on_refusal_(error.what());
  }
}

}  // namespace light_field_depth
