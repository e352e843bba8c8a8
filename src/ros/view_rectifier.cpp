#include "ros/view_rectifier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/error.h"
#include "ros/camera_info.h"

namespace light_field_depth
{
namespace
{
/// Below this an image of 2000 pixels moves by a twentieth of a pixel at its border: not worth a resampling.
constexpr double SAME_FOCAL_LENGTH = 5e-5;
/// Of an entry of P that is zero for rectified views: pixels for the first rows, and shares for the last.
constexpr double NO_TURN = 1e-9;
/// Sine of the largest angle by which a P may turn its view: a misalignment, not another direction.
constexpr double MAX_TURN = 0.09;

constexpr double KNOWN = 255.0;

cv::Matx33d planeMatrix(const sensor_msgs::CameraInfo& info)
{
  return {info.P[FX], 0.0, info.P[CX], 0.0, info.P[FY], info.P[CY], 0.0, 0.0, 1.0};
}

cv::Matx33d matrixFrom(const boost::array<double, 9>& values)
{
  return cv::Matx33d(values.data());
}

bool isZero(const cv::Matx33d& matrix)
{
  return std::all_of(matrix.val, matrix.val + 9, [](double entry) { return entry == 0.0; });
}

/// A message that says more is damaged.
constexpr std::uint32_t MAX_SIDE_PX = 1U << 16U;

void checkSize(const sensor_msgs::CameraInfo& info, const std::string& view_name)
{
  if (info.width < 1 || info.height < 1 || info.width > MAX_SIDE_PX || info.height > MAX_SIDE_PX)
  {
    throw InputError(view_name + ": its CameraInfo is that of an image of " + std::to_string(info.width) +
                     " x " + std::to_string(info.height) +
                     " pixels; publish that of the camera, with the binning and the region of its images.");
  }
}

template <class Values>
void checkFinite(const Values& values, const std::string& field, const std::string& view_name)
{
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
  {
    throw InputError(view_name + ": " + field +
                     " of its CameraInfo has a value that is no finite number; correct the calibration.");
  }
}

}  // namespace

ViewRectifier::ViewRectifier(const sensor_msgs::CameraInfo& info, bool raw, double focal_length_px,
                             const std::string& view_name)
    : rectified_(info)
{
  // The position in metres stays: P[3] and P[7] are in pixels times metres.
  for (const auto& [focal, translation] :
       {std::array<std::size_t, 2>{FX, TX}, std::array<std::size_t, 2>{FY, TY}})
  {
    const double difference = std::abs(info.P[focal] - focal_length_px);
    if (info.P[focal] > 0.0 && difference <= MAX_FOCAL_LENGTH_DIFFERENCE * focal_length_px)
    {
      rectified_.P[focal] = focal_length_px;
      rectified_.P[translation] = info.P[translation] * focal_length_px / info.P[focal];
    }
  }
  rectified_.D.assign(info.D.size(), 0.0);
  rectified_.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  if (raw)
  {
    useRaw(info, view_name);
  }
  else
  {
    useProjection(info, view_name);
  }
  if (!map_.empty())
  {
    const cv::Size size(static_cast<int>(info.width), static_cast<int>(info.height));
    const cv::Mat reached = knownAfterMap(cv::Mat(size, CV_8UC1, cv::Scalar(KNOWN)));
    reached_ = cv::countNonZero(reached) < static_cast<int>(reached.total()) ? reached : cv::Mat();
  }
  rectified_.K = {
      rectified_.P[FX], 0.0, rectified_.P[CX], 0.0, rectified_.P[FY], rectified_.P[CY], 0.0, 0.0, 1.0};
}

void ViewRectifier::useRaw(const sensor_msgs::CameraInfo& info, const std::string& view_name)
{
  const cv::Matx33d camera = matrixFrom(info.K);
  if (!(info.K[0] > 0.0 && info.K[4] > 0.0))
  {
    throw InputError(view_name +
                     ": K of its CameraInfo is not that of a calibrated camera, but 'rectify' needs it; "
                     "calibrate the camera, or set rectify to false.");
  }
  checkSize(info, view_name);
  checkFinite(info.K, "K", view_name);
  checkFinite(info.D, "D", view_name);
  checkFinite(info.R, "R", view_name);
  checkFinite(rectified_.P, "P", view_name);
  const cv::Matx33d turn = isZero(matrixFrom(info.R)) ? cv::Matx33d::eye() : matrixFrom(info.R);
  const cv::Size size(static_cast<int>(info.width), static_cast<int>(info.height));
  const cv::Mat distortion(info.D, true);
  const std::string& model = info.distortion_model;
  if (model == "equidistant" || model == "fisheye")
  {
    if (info.D.size() != 4)
    {
      throw InputError(view_name + ": D of its CameraInfo has " + std::to_string(info.D.size()) +
                       " coefficients, but the model '" + model + "' has 4; correct the calibration.");
    }
    cv::fisheye::initUndistortRectifyMap(camera, distortion, turn, planeMatrix(rectified_), size, CV_16SC2,
                                         map_, interpolation_);
  }
  else if (model.empty() || model == "plumb_bob" || model == "rational_polynomial")
  {
    const std::array<std::size_t, 6> counts = {0, 4, 5, 8, 12, 14};
    if (std::find(counts.begin(), counts.end(), info.D.size()) == counts.end())
    {
      throw InputError(view_name + ": D of its CameraInfo has " + std::to_string(info.D.size()) +
                       " coefficients; the model has 4, 5, 8, 12 or 14. Correct the calibration.");
    }
    cv::initUndistortRectifyMap(camera, distortion, turn, planeMatrix(rectified_), size, CV_16SC2, map_,
                                interpolation_);
  }
  else
  {
    throw InputError(
        view_name + ": the distortion model '" + model +
        "' of its CameraInfo is not known; use plumb_bob, rational_polynomial or equidistant, or "
        "rectify the images before.");
  }
}

/// An image that is said to be rectified shows what P projects: u = M K^-1 v for the pixel v of the plane,
/// with M the left part of P and K the plane's matrix.
void ViewRectifier::useProjection(const sensor_msgs::CameraInfo& info, const std::string& view_name)
{
  const boost::array<double, 12>& p = info.P;
  if (!(p[FX] > 0.0 && p[FY] > 0.0))
  {
    return;  // whoever reads the calibration says so
  }
  const double turn =
      std::max({std::abs(p[1]) / p[FX], std::abs(p[4]) / p[FY], std::abs(p[8]), std::abs(p[9])});
  const bool turned = !(turn <= NO_TURN);
  const auto differs = [&](std::size_t focal)
  { return std::abs(p[focal] - rectified_.P[focal]) > SAME_FOCAL_LENGTH * rectified_.P[focal]; };
  if (!turned && !differs(FX) && !differs(FY))
  {
    return;
  }
  if (!(turn <= MAX_TURN))
  {
    throw InputError(view_name + ": P of its CameraInfo turns the view (P[1] " + std::to_string(p[1]) +
                     ", P[4] " + std::to_string(p[4]) + ", P[8] " + std::to_string(p[8]) + ", P[9] " +
                     std::to_string(p[9]) + "); rectify all views to one plane.");
  }
  checkSize(info, view_name);
  const cv::Matx33d projection(p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10]);
  const cv::Vec3d centre = -(projection.inv() * cv::Vec3d(p[3], p[7], p[11]));
  rectified_.P = {rectified_.P[FX],
                  0.0,
                  p[CX],
                  -rectified_.P[FX] * centre[0],
                  0.0,
                  rectified_.P[FY],
                  p[CY],
                  -rectified_.P[FY] * centre[1],
                  0.0,
                  0.0,
                  1.0,
                  0.0};
  const cv::Matx33d to_source = projection * planeMatrix(rectified_).inv();
  cv::Mat x(static_cast<int>(info.height), static_cast<int>(info.width), CV_32FC1);
  cv::Mat y(x.size(), CV_32FC1);
  for (int row = 0; row < x.rows; ++row)
  {
    for (int column = 0; column < x.cols; ++column)
    {
      const cv::Vec3d source = to_source * cv::Vec3d(column, row, 1.0);
      x.at<float>(row, column) = static_cast<float>(source[0] / source[2]);
      y.at<float>(row, column) = static_cast<float>(source[1] / source[2]);
    }
  }
  cv::convertMaps(x, y, map_, interpolation_, CV_16SC2);
}

/// Known is what only known pixels are interpolated of.
cv::Mat ViewRectifier::knownAfterMap(const cv::Mat& mask) const
{
  cv::Mat share;
  cv::remap(mask, share, map_, interpolation_, cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(0.0));
  return share == KNOWN;
}

cv::Mat ViewRectifier::applyToMask(const cv::Mat& mask) const
{
  if (map_.empty())
  {
    return mask;
  }
  return mask.empty() ? reached_ : knownAfterMap(mask);
}

cv::Mat ViewRectifier::apply(const cv::Mat& image) const
{
  if (map_.empty())
  {
    return image;
  }
  cv::Mat rectified;
  cv::remap(image, rectified, map_, interpolation_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return rectified;
}

}  // namespace light_field_depth
