#include "ros/node_parameters.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include <image_transport/image_transport.h>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
constexpr double MAX_TOLERANCE_S = 10.0;
constexpr int MAX_QUEUE = 10000;
constexpr int MAX_THREADS = 1024;

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

/// Reads one parameter; a value of the wrong type is an error, not a reason to take the default.
template <class T>
bool read(const ros::NodeHandle& node_handle, const std::string& name, T& value)
{
  if (!node_handle.hasParam(name))
  {
    return false;
  }
  if (!node_handle.getParam(name, value))
  {
    throw InputError("The parameter '" + node_handle.resolveName(name) + "' is not " + typeName<T>() +
                     "; correct it or remove it.");
  }
  return true;
}

template <class T>
void readInRange(const ros::NodeHandle& node_handle, const std::string& name, T smallest, T largest, T& value)
{
  read(node_handle, name, value);
  if (!(value >= smallest && value <= largest))
  {
    throw InputError("The parameter '" + node_handle.resolveName(name) + "' is " + std::to_string(value) +
                     "; give a value from " + std::to_string(smallest) + " to " + std::to_string(largest) +
                     ".");
  }
}

CalibrationParameters readCalibration(const ros::NodeHandle& node_handle)
{
  CalibrationParameters calibration;
  read(node_handle, "baseline_x", calibration.baseline_x_m);
  read(node_handle, "baseline_y", calibration.baseline_y_m);
  read(node_handle, "focal_length", calibration.focal_length_px);
  read(node_handle, "disparity_offset", calibration.disparity_offset_px);
  cv::Point2d principal_point;
  const bool has_x = read(node_handle, "principal_point_x", principal_point.x);
  const bool has_y = read(node_handle, "principal_point_y", principal_point.y);
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

}  // namespace

NodeParameters readNodeParameters(const ros::NodeHandle& private_node_handle)
{
  NodeParameters parameters;
  XmlRpc::XmlRpcValue array;
  if (private_node_handle.getParam("array", array))
  {
    parameters.array = viewArrayFromParameter(array);
  }
  read(private_node_handle, "use_camera_info", parameters.use_camera_info);
  parameters.calibration = readCalibration(private_node_handle);
  if (!parameters.use_camera_info)
  {
    // Said now rather than at the first frame.
    calibrationFromParameters(gridOf(parameters.array), parameters.array.reference, parameters.calibration,
                              {});
  }
  readInRange(private_node_handle, "sync_tolerance", 0.0, MAX_TOLERANCE_S, parameters.sync_tolerance_s);
  readInRange(private_node_handle, "queue_size", 1, MAX_QUEUE, parameters.queue_size);
  read(private_node_handle, "keep_all", parameters.keep_all);
  readInRange(private_node_handle, "keep_all_limit", 1, MAX_QUEUE, parameters.keep_all_limit);
  read(private_node_handle, "lazy", parameters.lazy);
  readInRange(private_node_handle, "threads", 0, MAX_THREADS, parameters.threads);
  read(private_node_handle, "frame_id", parameters.frame_id);
  if (read(private_node_handle, "image_transport", parameters.image_transport))
  {
    checkTransport(private_node_handle, parameters.image_transport);
  }
  read(private_node_handle, "check_order", parameters.check_order);
  readInRange(private_node_handle, "patience", 0.1, 1e6, parameters.patience_s);
  return parameters;
}

}  // namespace light_field_depth
