#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_LIGHT_FIELD_ASSEMBLER_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_LIGHT_FIELD_ASSEMBLER_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <opencv2/core.hpp>

#include "light_field_depth/core/input_limits.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"
#include "light_field_depth/ros/calibration_from_camera_info.h"
#include "light_field_depth/ros/view_array.h"
#include "ros/view_image.h"
#include "ros/view_rectifier.h"

namespace light_field_depth
{
struct AssemblerOptions
{
  /// false: the calibration comes from the parameters alone.
  bool use_camera_info = true;

  /// true: the images are raw, and are rectified by their CameraInfo.
  bool rectify = false;

  /// What is black up to the border of an image, as it comes, is masked.
  bool mask_black = false;

  /// Views are reduced to one pixel for so many by so many.
  int decimation = 1;

  /// Of an image, as it comes.
  double max_megapixels = InputLimits().megapixels;
};

/// Makes light fields of whole sets of messages: decodes, rectifies and reduces the images, on the threads of
/// a pool. Keeps the calibration until a CameraInfo changes. Used by one thread at a time.
class LightFieldAssembler
{
public:
  /// @throw InputError for a mask_file of the array that cannot be read
  LightFieldAssembler(ViewArray array, CalibrationParameters parameters, const AssemblerOptions& options,
                      ThreadPool& pool);

  /// The images are shared with the messages where nothing has to be changed: the light field is to be used
  /// while they live. It has the views that have an image.
  /// @param images one for each view of the array, none where a camera is missing, which is not the reference
  /// @param infos  one for each view, null where none is known; not looked at when use_camera_info is false
  /// @param masks  from the topics of the array, null where there is none; empty: none at all
  /// @throw InputError
  LightField assemble(const std::vector<ViewImage>& images,
                      const std::vector<sensor_msgs::CameraInfoConstPtr>& infos,
                      const std::vector<sensor_msgs::ImageConstPtr>& masks = {});

  /// The camera of the reference view of the last light field: its CameraInfo without binning, region of
  /// interest, distortion and baseline, or what the parameters say of it. Zeros when it is not calibrated.
  sensor_msgs::CameraInfo referenceInfo() const;

  /// Whole sentences about the calibration in use; they change only when the calibration does.
  const std::vector<std::string>& warnings() const { return warnings_; }

private:
  /// What a view shows, and where it shows something (View::mask).
  struct Pixels
  {
    cv::Mat image;
    cv::Mat mask;
  };

  /// The CameraInfo of one view, as it came and as the calibration uses it.
  struct KnownCamera
  {
    std::size_t view;
    sensor_msgs::CameraInfo received;
    ViewRectifier rectifier;
  };

  void updateCalibration(const std::vector<sensor_msgs::CameraInfoConstPtr>& infos,
                         const cv::Size& image_size);
  void calibrate(const std::vector<sensor_msgs::CameraInfoConstPtr>& infos);
  void warnOfRawImages();
  void checkPresent(const std::vector<ViewImage>& images,
                    const std::vector<sensor_msgs::CameraInfoConstPtr>& infos) const;
  void checkSizes(const std::vector<Pixels>& views) const;
  std::vector<Pixels> decode(const std::vector<ViewImage>& images,
                             const std::vector<sensor_msgs::ImageConstPtr>& masks) const;
  void addGivenMasks(std::size_t view, const sensor_msgs::ImageConstPtr& message, Pixels& pixels) const;
  void rectify(std::vector<Pixels>& views) const;
  bool isCurrent(const std::vector<sensor_msgs::CameraInfoConstPtr>& infos) const;

  ViewArray array_;
  CalibrationParameters parameters_;
  AssemblerOptions options_;
  ThreadPool& pool_;
  std::vector<cv::Mat> file_masks_;         ///< of every view of the array, empty where it has none
  std::vector<KnownCamera> cameras_;        ///< that the calibration was made of
  std::optional<Calibration> calibration_;  ///< absent when depth is unknown
  std::vector<ViewGeometry> views_;         ///< of every view of the array; empty: to be found anew
  cv::Size image_size_;                     ///< of the last reference image
  std::vector<std::string> warnings_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_LIGHT_FIELD_ASSEMBLER_H
