#ifndef LIGHT_FIELD_DEPTH_ROS_CALIBRATION_FROM_CAMERA_INFO_H
#define LIGHT_FIELD_DEPTH_ROS_CALIBRATION_FROM_CAMERA_INFO_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sensor_msgs/CameraInfo.h>
#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// Calibration given by parameters, for arrays whose CameraInfo has no baseline, or none at all.
struct CalibrationParameters
{
  /// Metres from a column to the next and from a row to the next; 0: not given. Where only one is given it
  /// stands for both.
  double baseline_x_m = 0.0;
  double baseline_y_m = 0.0;  ///< see baseline_x_m

  /// The following are used only where no CameraInfo is used, or all have a P of zeros. Focal length in
  /// pixels; 0: not given.
  double focal_length_px = 0.0;
  /// Principal point of the reference view in pixels; the middle of the image when absent.
  std::optional<cv::Point2d> principal_point_px;
  /// Change of the principal point from a view to the next, in pixels (see Calibration).
  double disparity_offset_px = 0.0;

  bool hasBaseline() const { return baseline_x_m > 0.0 || baseline_y_m > 0.0; }  ///< whether one is given
};

/// One whole sentence for each field that cannot be used.
std::vector<std::string> validate(const CalibrationParameters& parameters);

/// Where one view stands, as View wants it.
struct ViewGeometry
{
  cv::Point2d steps;      ///< relative to the reference view
  cv::Point2d offset_px;  ///< what steps * disparity_offset_px does not explain of its principal point
};

/// Calibration of a whole array: the pinhole model and where each view stands.
struct ArrayCalibration
{
  /// Absent where nothing says how large the array is or how far its cameras see: there is disparity then,
  /// but no depth, and a warning that says so.
  std::optional<Calibration> calibration;
  std::vector<ViewGeometry> views;    ///< in the order of the grid positions that were given
  std::vector<std::string> warnings;  ///< whole sentences: what can be used but should be looked at
};

/// Calibration of an array from the projection matrix P of each view's CameraInfo.
///
/// A view k stands at (Bx, By) = (-P[3] / P[0], -P[7] / P[5]) metres and has its principal point c_k at
/// (P[2], P[6]). A scene point (X, Y, Z) in the frame of the reference view, seen there at u, is seen by view
/// k at
///   u_k = f (X - Bx) / Z + c_k = u - f Bx / Z + (c_k - c_ref).
/// With T the baseline of adjacent views and s_k = Bx / T the view's steps,
///   u_k = u - s_k f T / Z + (c_k - c_ref).
/// The part of c_k - c_ref that is linear in the steps, s_k d_inf, joins the parallax: the disparity that the
/// images show is d = f T / Z - d_inf, hence Z = f T / (d + d_inf). What is not linear is the view's offset.
/// So d_inf is *plus* the change of the principal point from a view to the next one on its right (below). A
/// light field that is sheared to focus on a plane at depth F has d = 0 there, and d_inf = f T / F > 0, which
/// is the HCI benchmark's formula: principal points move along with the cameras.
///
/// T is the median distance of neighbours in a row (in a column where no row has two views), d_inf the least
/// squares fit over all views.
///
/// Where every P is zero, the cameras are not calibrated: the parameters take their place. Where no P has a
/// baseline and the parameters have none, the views count as standing on an ideal grid of unknown size.
///
/// @param grid    grid position of each view
/// @param infos   CameraInfo of each view, of the image as it comes: binning and region of interest applied
/// @param reference index of the reference view
/// @param parameters the baseline is taken from them where no P has one
/// @throw InputError that names view, field, value and remedy: P[0] or P[5] not positive or not finite, focal
///   lengths that differ, image sizes that differ, positions against the order of rows and columns
ArrayCalibration calibrationFromCameraInfo(const std::vector<GridPosition>& grid,
                                           const std::vector<sensor_msgs::CameraInfo>& infos,
                                           std::size_t reference,
                                           const CalibrationParameters& parameters = {});

/// The same from parameters alone, on an ideal grid; no calibration if neither focal length nor baseline is
/// given.
/// @throw InputError if only one of them is given
ArrayCalibration calibrationFromParameters(const std::vector<GridPosition>& grid, std::size_t reference,
                                           const CalibrationParameters& parameters,
                                           const cv::Size& image_size);

/// The inverse of calibrationFromCameraInfo() for one view: a rectified camera without distortion. Header and
/// frame are left empty.
sensor_msgs::CameraInfo cameraInfoFor(const View& view, const Calibration& calibration,
                                      const cv::Size& image_size);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_ROS_CALIBRATION_FROM_CAMERA_INFO_H
