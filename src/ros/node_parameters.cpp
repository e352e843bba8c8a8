#include "ros/node_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include <image_transport/image_transport.h>

#include "light_field_depth/core/error.h"
#include "light_field_depth/ros/camera_info_url.h"
#include "ros/parameter_check.h"

namespace light_field_depth
{
namespace
{
// Larger values of parameters are slips of the pen, and would take all memory or wait for ever.
constexpr double MAX_TOLERANCE_S = 10.0;
constexpr int MAX_QUEUE = 10000;
constexpr int MAX_THREADS = 1024;
constexpr int MAX_DECIMATION = 16;
constexpr double MAX_SECONDS = 1e6;
constexpr double MAX_MEMORY_MB = 1e9;
constexpr double MAX_MEGAPIXELS = 1e6;
constexpr double SMALLEST_LIMIT = 1e-3;  ///< of MB and megapixels

template <class T>
const char* typeName()
{
  if constexpr (std::is_same_v<T, bool>)
  {
    return "true or false";
  }
  else if constexpr (std::is_same_v<T, std::string>)
  {
    return "a text";
  }
  else
  {
    return std::is_same_v<T, int> ? "a whole number" : "a number";
  }
}

/// Reads parameters and remembers which there are.
class ParameterReader
{
public:
  explicit ParameterReader(const ros::NodeHandle& node_handle) : node_handle_(node_handle) {}

  /// A value of the wrong type is an error, not a reason to take the default. @return whether there is one
  template <class T>
  bool read(const std::string& name, T& value)
  {
    names_.insert(name);
    if (!node_handle_.hasParam(name))
    {
      return false;
    }
    if (!node_handle_.getParam(name, value))
    {
      throw InputError("The parameter '" + node_handle_.resolveName(name) + "' is not " + typeName<T>() +
                       "; correct it or remove it.");
    }
    return true;
  }

  template <class T>
  void readInRange(const std::string& name, T smallest, T largest, T& value)
  {
    read(name, value);
    if (!(value >= smallest && value <= largest))
    {
      throw InputError("The parameter '" + node_handle_.resolveName(name) + "' is " + std::to_string(value) +
                       "; give a value from " + std::to_string(smallest) + " to " + std::to_string(largest) +
                       ".");
    }
  }

  const std::set<std::string>& names() const { return names_; }

private:
  const ros::NodeHandle& node_handle_;
  std::set<std::string> names_;
};

CalibrationParameters readCalibration(ParameterReader& reader)
{
  CalibrationParameters calibration;
  reader.read("baseline_x", calibration.baseline_x_m);
  reader.read("baseline_y", calibration.baseline_y_m);
  reader.read("focal_length", calibration.focal_length_px);
  reader.read("disparity_offset", calibration.disparity_offset_px);
  cv::Point2d principal_point;
  const bool has_x = reader.read("principal_point_x", principal_point.x);
  const bool has_y = reader.read("principal_point_y", principal_point.y);
  if (has_x != has_y)
  {
    throw InputError(
        "Only one of the parameters 'principal_point_x' and 'principal_point_y' is set; set both or "
        "neither.");
  }
  if (has_x)
  {
    calibration.principal_point_px = principal_point;
  }
  for (const std::string& problem : validate(calibration))
  {
    throw InputError(problem);
  }
  return calibration;
}

void readHealth(ParameterReader& reader, HealthThresholds& health)
{
  // A share above 1 is never reached.
  reader.readInRange("warn_incomplete", 0.0, 2.0, health.warn_incomplete);
  reader.readInRange("error_incomplete", 0.0, 2.0, health.error_incomplete);
  reader.readInRange("warn_replaced", 0.0, 2.0, health.warn_replaced);
  reader.readInRange("error_replaced", 0.0, 2.0, health.error_replaced);
  reader.readInRange("warn_latency", 0.0, MAX_SECONDS, health.warn_latency_s);
  reader.readInRange("error_latency", 0.0, MAX_SECONDS, health.error_latency_s);
}

/// An unknown transport would throw at the first subscription, from a callback.
void checkTransport(const ros::NodeHandle& node_handle, const std::string& transport)
{
  const std::vector<std::string> known = image_transport::ImageTransport(node_handle).getLoadableTransports();
  const std::string prefix = "image_transport/";
  if (std::find(known.begin(), known.end(), prefix + transport) != known.end())
  {
    return;
  }
  std::string names;
  for (const std::string& name : known)
  {
    names += (names.empty() ? "" : ", ") + name.substr(std::min(prefix.size(), name.size()));
  }
  throw InputError("The parameter '" + node_handle.resolveName("image_transport") + "' is '" + transport +
                   "'; install that transport, or choose one of: " + names + ".");
}

/// Which sets there are.
void readSets(const ros::NodeHandle& node_handle, ParameterReader& reader, NodeParameters& parameters)
{
  XmlRpc::XmlRpcValue array;
  if (reader.read("array", array))
  {
    parameters.array = viewArrayFromParameter(array);
  }
  reader.readInRange("max_views", 2, std::numeric_limits<int>::max(), parameters.limits.views);
  requireViews(parameters.array.views.size(), parameters.limits.views,
               "Give the array fewer views, or raise max_views.");
  reader.readInRange("max_message_size", SMALLEST_LIMIT, MAX_MEMORY_MB, parameters.limits.message_mb);
  reader.readInRange("sync_tolerance", 0.0, MAX_TOLERANCE_S, parameters.sync_tolerance_s);
  reader.readInRange("queue_size", 1, MAX_QUEUE, parameters.queue_size);
  reader.read("keep_all", parameters.keep_all);
  reader.readInRange("keep_all_limit", 1, MAX_QUEUE, parameters.keep_all_limit);
  reader.readInRange("patience", 0.1, MAX_SECONDS, parameters.patience_s);
  if (reader.read("image_transport", parameters.image_transport) &&
      parameters.image_transport != COMPRESSED_TRANSPORT)
  {
    checkTransport(node_handle, parameters.image_transport);
  }
}

}  // namespace

std::size_t queueCapacity(const NodeParameters& parameters)
{
  return parameters.keep_all ? static_cast<std::size_t>(parameters.keep_all_limit) : 1;
}

NodeParameters readSetParameters(const ros::NodeHandle& private_node_handle, NodeParameters defaults)
{
  ParameterReader reader(private_node_handle);
  readSets(private_node_handle, reader, defaults);
  return defaults;
}

NodeParameters readNodeParameters(const ros::NodeHandle& private_node_handle)
{
  NodeParameters parameters;
  ParameterReader reader(private_node_handle);
  readSets(private_node_handle, reader, parameters);
  parameters.camera_infos = readCameraInfos(parameters.array);
  reader.read("use_camera_info", parameters.use_camera_info);
  parameters.calibration = readCalibration(reader);
  if (!parameters.use_camera_info)
  {
    // Said now rather than at the first frame.
    calibrationFromParameters(gridOf(parameters.array), parameters.array.reference, parameters.calibration,
                              {});
  }
  reader.read("lazy", parameters.lazy);
  reader.readInRange("threads", 0, MAX_THREADS, parameters.threads);
  reader.readInRange("max_megapixels", SMALLEST_LIMIT, MAX_MEGAPIXELS, parameters.limits.megapixels);
  reader.readInRange("max_memory", 0.0, MAX_MEMORY_MB, parameters.max_memory_mb);
  reader.read("frame_id", parameters.frame_id);
  reader.read("target_frame", parameters.target_frame);
  reader.read("publish_tf", parameters.publish_tf);
  reader.read("paused", parameters.paused);
  reader.read("save_directory", parameters.save_directory);
  reader.read("rectify", parameters.rectify);
  reader.read("mask_black", parameters.mask_black);
  reader.readInRange("decimation", 1, MAX_DECIMATION, parameters.decimation);
  if (parameters.rectify && !parameters.use_camera_info)
  {
    throw InputError(
        "rectify is true, but use_camera_info is false; views are rectified by their CameraInfo.");
  }
  reader.read("check_order", parameters.check_order);
  reader.readInRange("min_views", 0, static_cast<int>(parameters.array.views.size()), parameters.min_views);
  reader.read("allow_incomplete", parameters.allow_incomplete);
  readHealth(reader, parameters.health);

  parameters.warnings = checkSettings(private_node_handle);
  std::set<std::string> names = reader.names();
  names.insert("diagnostic_period");  // of diagnostic_updater
  for (std::string& sentence : describeUnknownParameters(private_node_handle, names))
  {
    parameters.warnings.push_back(std::move(sentence));
  }
  return parameters;
}

}  // namespace light_field_depth
