#include "ros/cloud_transformer.h"

#include <utility>

#include <geometry_msgs/TransformStamped.h>
#include <pcl_ros/transforms.h>
#include <ros/duration.h>
#include <Eigen/Geometry>
#include <boost/make_shared.hpp>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
/// A transform comes as often as a robot's joints are read: some of their periods.
const ros::Duration PATIENCE(0.2);

Eigen::Matrix4f matrixOf(const geometry_msgs::Transform& transform)
{
  const geometry_msgs::Quaternion& q = transform.rotation;
  const geometry_msgs::Vector3& t = transform.translation;
  Eigen::Isometry3d isometry(Eigen::Quaterniond(q.w, q.x, q.y, q.z));
  isometry.pretranslate(Eigen::Vector3d(t.x, t.y, t.z));
  return isometry.matrix().cast<float>();
}

}  // namespace

CloudTransformer::CloudTransformer(std::string target_frame)
    : target_frame_(std::move(target_frame)), listener_(buffer_)
{
}

sensor_msgs::PointCloud2Ptr CloudTransformer::transform(const sensor_msgs::PointCloud2& cloud) const
{
  geometry_msgs::TransformStamped transform;
  try
  {
    transform = buffer_.lookupTransform(target_frame_, cloud.header.frame_id, cloud.header.stamp, PATIENCE);
  }
  catch (const tf2::TransformException& error)
  {
    throw InputError("tf does not bring '" + cloud.header.frame_id + "' into target_frame '" + target_frame_ +
                     "', so the clouds are left out: " + error.what() +
                     " Publish that transform, or leave target_frame empty.");
  }
  auto transformed = boost::make_shared<sensor_msgs::PointCloud2>();
  pcl_ros::transformPointCloud(matrixOf(transform.transform), cloud, *transformed);
  transformed->header.frame_id = target_frame_;
  transformed->header.stamp = cloud.header.stamp;
  return transformed;
}

}  // namespace light_field_depth
