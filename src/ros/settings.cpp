#include "ros/settings.h"

#include <type_traits>
#include <utility>

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

}  // namespace

NodeSettings settingsFrom(const LightFieldDepthConfig& config)
{
  NodeSettings settings;
  settings.dense_cloud = config.dense_cloud;
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
