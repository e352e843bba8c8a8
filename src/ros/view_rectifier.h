#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_RECTIFIER_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_RECTIFIER_H

#include <string>

#include <sensor_msgs/CameraInfo.h>
#include <opencv2/core.hpp>

namespace light_field_depth
{
/// Brings the image of one view onto the common plane of the array: pixels of the reference view's focal
/// length, square, without rotation. One interpolation, whatever has to be done; the maps are made once.
class ViewRectifier
{
public:
  /// Largest relative difference of a focal length from the reference's that is made up for; more is another
  /// lens, or a calibration of something else.
  static constexpr double MAX_FOCAL_LENGTH_DIFFERENCE = 0.02;

  /// @param info      of the image as it comes, see ofDeliveredImage()
  /// @param raw       whether the image still has the distortion D and the rotation R
  /// @param focal_length_px of the plane
  /// @param view_name begins the sentence of an error
  /// @throw InputError if the image cannot be brought onto the plane: no calibration of the raw image, an
  ///   unknown model of distortion, or a P that turns it by more than a few degrees
  ViewRectifier(const sensor_msgs::CameraInfo& info, bool raw, double focal_length_px,
                const std::string& view_name);

  /// The camera that the result has: P with the plane's focal length, D of zeros, R of ones. The focal length
  /// is that of `info` where it differs by too much.
  const sensor_msgs::CameraInfo& rectified() const { return rectified_; }

  bool changesImage() const { return !map_.empty(); }

  /// @return the image itself where nothing is to be done. What lies outside repeats the border.
  cv::Mat apply(const cv::Mat& image) const;

  /// The mask (View::mask) of the rectified image, for that of the image: masked is also what lies outside of
  /// the image. Empty if nothing is masked. @param mask empty, or CV_8UC1 in the size of the image, 0 or 255
  cv::Mat applyToMask(const cv::Mat& mask) const;

private:
  cv::Mat knownAfterMap(const cv::Mat& mask) const;
  void useRaw(const sensor_msgs::CameraInfo& info, const std::string& view_name);
  void useProjection(const sensor_msgs::CameraInfo& info, const std::string& view_name);

  sensor_msgs::CameraInfo rectified_;
  cv::Mat map_;            ///< CV_16SC2; empty: the image is what it should be
  cv::Mat interpolation_;  ///< CV_16UC1
  cv::Mat reached_;        ///< mask of what the map finds in the image; empty: everything
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_RECTIFIER_H
