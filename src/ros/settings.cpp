#include "light_field_depth/ros/settings.h"

#include <utility>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
NodeSettings settingsFrom(const LightFieldDepthConfig& config)
{
  NodeSettings settings;
  settings.dense_cloud = config.dense_cloud;
  PipelineOptions& pipeline = settings.pipeline;
  pipeline.method = methodFromString(config.method);
  pipeline.views = viewSelectionFromString(config.views);
  if (!config.disparity_range_auto)
  {
    pipeline.disparity_range =
        DisparityRange{static_cast<float>(config.disparity_min), static_cast<float>(config.disparity_max)};
  }
  pipeline.min_confidence = static_cast<float>(config.min_confidence);
  pipeline.dense_cloud.min_confidence = static_cast<float>(config.dense_cloud_min_confidence);
  pipeline.dense_cloud.voxel_size_m = static_cast<float>(config.dense_cloud_voxel_size_m);

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
