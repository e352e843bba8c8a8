#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_LIGHT_FIELD_ASSEMBLER_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_LIGHT_FIELD_ASSEMBLER_H

#include <optional>
#include <string>
#include <vector>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/ros/calibration_from_camera_info.h"
#include "light_field_depth/ros/view_array.h"

namespace light_field_depth
{
/// Makes light fields of whole sets of messages. Keeps the calibration until a CameraInfo changes. Used by
/// one thread at a time.
class LightFieldAssembler
{
public:
  /// @param use_camera_info false: the calibration comes from the parameters alone
  LightFieldAssembler(ViewArray array, CalibrationParameters parameters, bool use_camera_info);

  /// The images are shared with the messages where their encoding allows: the light field is to be used while
  /// they live.
  /// @param images one for each view of the array
  /// @param infos  one for each view, null where none is known; not looked at when use_camera_info is false
  /// @throw InputError
  LightField assemble(const std::vector<sensor_msgs::ImageConstPtr>& images,
                      const std::vector<sensor_msgs::CameraInfoConstPtr>& infos);

  /// Whole sentences about the calibration in use; they change only when the calibration does.
  const std::vector<std::string>& warnings() const { return warnings_; }

private:
  void updateCalibration(const std::vector<sensor_msgs::CameraInfoConstPtr>& infos,
                         const cv::Size& image_size);
  void checkPresent(const std::vector<sensor_msgs::CameraInfoConstPtr>& infos) const;
  void checkSizes(const std::vector<sensor_msgs::ImageConstPtr>& images) const;
  bool isCurrent(const std::vector<sensor_msgs::CameraInfoConstPtr>& infos) const;

  ViewArray array_;
  CalibrationParameters parameters_;
  bool use_camera_info_;
  std::vector<sensor_msgs::CameraInfo> infos_;  ///< that calibration_ was made of
  std::optional<ArrayCalibration> calibration_;
  std::vector<std::string> warnings_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_LIGHT_FIELD_ASSEMBLER_H
