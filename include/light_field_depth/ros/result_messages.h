#ifndef LIGHT_FIELD_DEPTH_ROS_RESULT_MESSAGES_H
#define LIGHT_FIELD_DEPTH_ROS_RESULT_MESSAGES_H

#include <cstddef>
#include <optional>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>
#include <stereo_msgs/DisparityImage.h>
#include <opencv2/core.hpp>

#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/point_cloud.h"

namespace light_field_depth
{
/// Results as messages: pure functions, no ROS master needed.

/// The disparity of the reference view for any consumer of stereo disparities: the image holds d + d_inf, in
/// pixels between adjacent views, so that Z = f T / value; min_disparity and max_disparity bound the valid
/// values. Where the confidence is too low, or what is filled is not kept, or a point would lie at infinity
/// or behind the camera, the value is min_disparity - 1. The valid window bounds what the
/// mask of the view leaves. Without a calibration f and T are 0, and the image holds d.
stereo_msgs::DisparityImagePtr disparityMessage(const std_msgs::Header& header,
                                                const DisparityEstimate& estimate,
                                                const std::optional<Calibration>& calibration,
                                                float min_confidence, bool keep_filled);

/// The two cameras that a stereo pair with the same disparity has: parallel, with the principal point of the
/// reference view in both, the right one baseline_m to the right of the left one. For consumers that take two
/// CameraInfos with a disparity, and would subtract a difference of principal points from it.
struct StereoPair
{
  sensor_msgs::CameraInfoPtr left;   ///< of the reference view
  sensor_msgs::CameraInfoPtr right;  ///< of the view beside it
};
StereoPair stereoPair(const std_msgs::Header& header, const Calibration& calibration, const cv::Size& size);

/// A 32FC1 image. @param values CV_32FC1
sensor_msgs::ImagePtr floatImageMessage(const std_msgs::Header& header, const cv::Mat& values);

/// Depth as a 16UC1 image in millimetres (REP 118): 0 where unknown or beyond 65.535 m. @param depth_m
/// CV_32FC1
sensor_msgs::ImagePtr millimetreImageMessage(const std_msgs::Header& header, const cv::Mat& depth_m);

/// Confidence as a mono8 image, 255 for 1, for consumers that take an intensity. @param confidence CV_32FC1
sensor_msgs::ImagePtr confidenceMono8Message(const std_msgs::Header& header, const cv::Mat& confidence);

/// The disparity in colours (bgr8, blue is far, red is near, from the lowest to the highest of the range
/// that was searched), for eyes only.
sensor_msgs::ImagePtr disparityColorMessage(const std_msgs::Header& header,
                                            const DisparityEstimate& estimate);

/// Makes a message of any content a cloud of x y z rgb confidence in 20 bytes a point;
/// organised, with NaN, is_dense false. @return where its points go, size.area() of them, row-major
/// @throw InputError if the message would be larger than ROS transports (1e9 bytes)
ColoredPoint* shapeOrganizedCloud(const std_msgs::Header& header, const cv::Size& size,
                                  sensor_msgs::PointCloud2& cloud);

/// Begins an unorganised cloud of the same points, without NaN, is_dense true.
void beginDenseCloud(const std_msgs::Header& header, sensor_msgs::PointCloud2& cloud);

/// Of how many points one has to be kept for at most so many points to fit into a message (1e9 bytes).
std::size_t thinningOfDenseCloud(std::size_t most_points);

/// Appends every nth of the points to a cloud that was begun, as long as ROS transports it.
void appendDensePoints(const DensePoint* points, std::size_t count, std::size_t every_nth,
                       sensor_msgs::PointCloud2& cloud);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_ROS_RESULT_MESSAGES_H
