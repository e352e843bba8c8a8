#ifndef LIGHT_FIELD_DEPTH_ROS_ARRAY_CHECK_H
#define LIGHT_FIELD_DEPTH_ROS_ARRAY_CHECK_H

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/ros/calibration_from_camera_info.h"
#include "light_field_depth/ros/view_array.h"

namespace light_field_depth
{
/// One thing that was looked at.
struct ArrayFinding
{
  /// How much a finding says against the array.
  enum class Severity
  {
    Fine,     ///< for the record
    Warning,  ///< works, but worse than it could
    Error     ///< the array gives nothing, or wrong depth
  };

  Severity severity = Severity::Fine;  ///< how much it says against the array
  std::string sentence;                ///< with the view, the figure, and the remedy if it is no Fine one
};

/// What an array is to be checked with; fields as the node's parameters of the same names.
struct ArrayCheckOptions
{
  double sync_tolerance_s = 0.0;      ///< seconds
  bool use_camera_info = true;        ///< false: the calibration below counts alone
  bool rectify = false;               ///< the images are raw
  bool mask_black = false;            ///< black borders show nothing
  int decimation = 1;                 ///< views are reduced by so much
  CalibrationParameters calibration;  ///< where CameraInfos have none
};

/// What came on the topics of an array, and what is to be thought of it. Used by one thread at a time.
class ArrayCheck
{
public:
  /// @param array whose topics are looked at
  ArrayCheck(ViewArray array, const ArrayCheckOptions& options);
  ~ArrayCheck();
  ArrayCheck(const ArrayCheck&) = delete;
  ArrayCheck& operator=(const ArrayCheck&) = delete;

  /// A message of a view. @pre view < array().views.size()
  void add(std::size_t view, const sensor_msgs::ImageConstPtr& image);
  void add(std::size_t view, const sensor_msgs::CompressedImageConstPtr& image);  ///< likewise
  void add(std::size_t view, const sensor_msgs::CameraInfoConstPtr& info);        ///< likewise

  const ViewArray& array() const;  ///< that is checked

  /// The sync_tolerance in seconds that brings the images together: the given one, or what the stamps of most
  /// frames need. 0 where they are equal.
  double neededToleranceS() const;

  /// Judges what came: missing views and CameraInfos, rates, stamps, calibration, order of the views,
  /// brightness, views that are off their places, and whether a result can be right. Errors first.
  std::vector<ArrayFinding> judge(Pipeline& pipeline);

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_ROS_ARRAY_CHECK_H
