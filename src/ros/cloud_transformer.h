#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_CLOUD_TRANSFORMER_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_CLOUD_TRANSFORMER_H

#include <string>

#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

namespace light_field_depth
{
/// Brings clouds into a frame that tf knows. Thread safe.
class CloudTransformer
{
public:
  explicit CloudTransformer(std::string target_frame);

  /// Waits a little for a transform that is on its way.
  /// @throw InputError if tf has no transform at the stamp of the cloud
  sensor_msgs::PointCloud2Ptr transform(const sensor_msgs::PointCloud2& cloud) const;

private:
  std::string target_frame_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_CLOUD_TRANSFORMER_H
