#include "light_field_depth/ros/calibration_from_camera_info.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

#include <Eigen/Core>

#include "light_field_depth/core/error.h"
#include "ros/array_baseline.h"
#include "ros/camera_info.h"

namespace light_field_depth
{
namespace
{
/// Rectified views share a focal length; rounding in calibration files stays far below this.
constexpr double MAX_FOCAL_LENGTH_DIFFERENCE = 1e-3;
/// A baseline given by hand that differs by more from the CameraInfo's deserves a warning.
constexpr double MAX_BASELINE_DIFFERENCE = 1e-2;
/// Positions nearer than this to one another are one place, in metres.
constexpr double SAME_PLACE_M = 1e-9;
/// A view that strays from its place in the grid by more than this share of a step deserves a warning.
constexpr double MAX_GRID_DEVIATION = 0.5;
/// Cameras that stand farther apart are rarer than a P in millimetres. Set by hand.
constexpr double LARGE_BASELINE_M = 5.0;

/// Two numbers for each view.
using Pairs = Eigen::Matrix<double, Eigen::Dynamic, 2>;

std::string number(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string nameOf(const GridPosition& position)
{
  return "View " + toString(position);
}

void checkProjection(const GridPosition& position, const sensor_msgs::CameraInfo& info)
{
  for (std::size_t i = 0; i < info.P.size(); ++i)
  {
    if (!std::isfinite(info.P[i]))
    {
      throw InputError(nameOf(position) + ": P[" + std::to_string(i) + "] of its CameraInfo is " +
                       number(info.P[i]) + "; publish a projection matrix of finite numbers.");
    }
  }
  for (const std::size_t entry : {FX, FY})
  {
    if (info.P[entry] <= 0.0)
    {
      throw InputError(nameOf(position) + ": P[" + std::to_string(entry) +
                       "] (the focal length) of its CameraInfo is " + number(info.P[entry]) +
                       "; calibrate the camera, or publish the P of the rectified image.");
    }
  }
}

void checkFocalLength(const GridPosition& position, const sensor_msgs::CameraInfo& info, std::size_t entry,
                      const GridPosition& reference_position, double reference_focal_length)
{
  if (std::abs(info.P[entry] - reference_focal_length) > MAX_FOCAL_LENGTH_DIFFERENCE * reference_focal_length)
  {
    throw InputError(nameOf(position) + ": P[" + std::to_string(entry) +
                     "] (the focal length) of its CameraInfo is " + number(info.P[entry]) +
                     " px, but P[0] of the reference view " + toString(reference_position) + " is " +
                     number(reference_focal_length) +
                     " px; rectify all views to one focal length with square pixels.");
  }
}

void checkInfos(const std::vector<GridPosition>& grid, const std::vector<sensor_msgs::CameraInfo>& infos,
                std::size_t reference)
{
  for (std::size_t i = 0; i < infos.size(); ++i)
  {
    checkProjection(grid[i], infos[i]);
  }
  const sensor_msgs::CameraInfo& first = infos[reference];
  for (std::size_t i = 0; i < infos.size(); ++i)
  {
    checkFocalLength(grid[i], infos[i], FX, grid[reference], first.P[FX]);
    checkFocalLength(grid[i], infos[i], FY, grid[reference], first.P[FX]);
    if (infos[i].width != first.width || infos[i].height != first.height)
    {
      throw InputError(nameOf(grid[i]) + ": the size in its CameraInfo is " + std::to_string(infos[i].width) +
                       " x " + std::to_string(infos[i].height) + ", but that of the reference view " +
                       toString(grid[reference]) + " is " + std::to_string(first.width) + " x " +
                       std::to_string(first.height) + "; rectify all views to one size.");
    }
  }
}

cv::Point2d positionOf(const sensor_msgs::CameraInfo& info)
{
  return {-info.P[TX] / info.P[FX], -info.P[TY] / info.P[FY]};
}

cv::Point2d principalPointOf(const sensor_msgs::CameraInfo& info)
{
  return {info.P[CX], info.P[CY]};
}

std::vector<cv::Point2d> positionsFrom(const std::vector<sensor_msgs::CameraInfo>& infos,
                                       std::size_t reference)
{
  std::vector<cv::Point2d> positions;
  positions.reserve(infos.size());
  for (const sensor_msgs::CameraInfo& info : infos)
  {
    positions.push_back(positionOf(info) - positionOf(infos[reference]));
  }
  return positions;
}

bool atOnePlace(const std::vector<cv::Point2d>& positions)
{
  return std::all_of(positions.begin(), positions.end(),
                     [](const cv::Point2d& position)
                     { return std::abs(position.x) + std::abs(position.y) < SAME_PLACE_M; });
}

/// The positions on an ideal grid with the baselines of the parameters.
std::vector<cv::Point2d> positionsFrom(const std::vector<GridPosition>& grid, std::size_t reference,
                                       const CalibrationParameters& parameters)
{
  const double x = parameters.baseline_x_m > 0.0 ? parameters.baseline_x_m : parameters.baseline_y_m;
  const double y = parameters.baseline_y_m > 0.0 ? parameters.baseline_y_m : parameters.baseline_x_m;
  std::vector<cv::Point2d> positions;
  positions.reserve(grid.size());
  for (const GridPosition& position : grid)
  {
    positions.emplace_back(x * (position.column - grid[reference].column),
                           y * (position.row - grid[reference].row));
  }
  return positions;
}

Pairs pairsOf(const std::vector<cv::Point2d>& points)
{
  Pairs pairs(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    pairs.row(static_cast<Eigen::Index>(i)) << points[i].x, points[i].y;
  }
  return pairs;
}

/// Change of the principal point for one step: the least squares fit of shift = steps * d_inf.
double fitDisparityOffset(const std::vector<cv::Point2d>& steps, const std::vector<cv::Point2d>& shifts)
{
  const Pairs along = pairsOf(steps);
  return along.cwiseProduct(pairsOf(shifts)).sum() / along.squaredNorm();
}

void warnOfOtherBaseline(double given_m, double found_m, const char* parameter,
                         std::vector<std::string>& warnings)
{
  if (given_m > 0.0 && std::abs(given_m - found_m) > MAX_BASELINE_DIFFERENCE * found_m)
  {
    warnings.push_back(std::string(parameter) + " is " + number(given_m) + " m, but the CameraInfo of the " +
                       "views says " + number(found_m) + " m; the CameraInfo is used. Remove the parameter " +
                       "or correct one of them.");
  }
}

/// A view far from its place is more often a swapped topic than a bent array.
void warnOfStrayViews(const std::vector<GridPosition>& grid, std::size_t reference,
                      const std::vector<ViewGeometry>& views, const cv::Point2d& unit,
                      std::vector<std::string>& warnings)
{
  for (std::size_t i = 0; i < grid.size(); ++i)
  {
    const cv::Point2d expected(unit.x * (grid[i].column - grid[reference].column),
                               unit.y * (grid[i].row - grid[reference].row));
    const cv::Point2d deviation = views[i].steps - expected;
    if (std::max(std::abs(deviation.x), std::abs(deviation.y)) > MAX_GRID_DEVIATION)
    {
      warnings.push_back(nameOf(grid[i]) + " stands " + number(deviation.x) + " steps to the right of and " +
                         number(deviation.y) +
                         " steps below its place in the grid; check that its topics and its P are its own.");
    }
  }
}

/// Positions in steps of the grid, where nobody knows how long a step is.
std::vector<cv::Point2d> gridSteps(const std::vector<GridPosition>& grid, std::size_t reference)
{
  CalibrationParameters unit;
  unit.baseline_x_m = 1.0;
  return positionsFrom(grid, reference, unit);
}

/// An array of unknown size: disparity only.
ArrayCalibration idealGrid(const std::vector<GridPosition>& grid, std::size_t reference,
                           const std::string& warning)
{
  ArrayCalibration result;
  for (const cv::Point2d& steps : gridSteps(grid, reference))
  {
    result.views.push_back({steps, {0.0, 0.0}});
  }
  result.warnings.push_back(warning);
  return result;
}

/// @param fields where the baseline comes from, and in what unit
void warnOfLargeBaseline(double baseline_m, const std::string& fields, std::vector<std::string>& warnings)
{
  if (baseline_m > LARGE_BASELINE_M)
  {
    warnings.push_back("Adjacent cameras stand " + number(baseline_m) + " m apart by " + fields +
                       ", and depths are as large; divide by 1000 if they stand " + number(baseline_m) +
                       " mm apart.");
  }
}

void checkCounts(std::size_t views, std::size_t infos, std::size_t reference)
{
  if (views < 2 || infos != views || reference >= views)
  {
    throw InputError(
        "The calibration of an array needs at least two views with one CameraInfo each; there are " +
        std::to_string(views) + " views and " + std::to_string(infos) + " CameraInfo messages.");
  }
}

}  // namespace

std::vector<std::string> validate(const CalibrationParameters& parameters)
{
  std::vector<std::string> problems;
  const auto check = [&](double value, const char* name)
  {
    if (!std::isfinite(value) || value < 0.0)
    {
      problems.push_back(std::string(name) + " is " + number(value) +
                         "; give a positive number, or 0 to leave it out.");
    }
  };
  check(parameters.baseline_x_m, "baseline_x");
  check(parameters.baseline_y_m, "baseline_y");
  check(parameters.focal_length_px, "focal_length");
  if (!std::isfinite(parameters.disparity_offset_px))
  {
    problems.emplace_back(
        "disparity_offset is not a finite number of pixels; give one, or 0 for parallel cameras.");
  }
  return problems;
}

ArrayCalibration calibrationFromCameraInfo(const std::vector<GridPosition>& grid,
                                           const std::vector<sensor_msgs::CameraInfo>& infos,
                                           std::size_t reference, const CalibrationParameters& parameters)
{
  checkCounts(grid.size(), infos.size(), reference);
  if (std::all_of(infos.begin(), infos.end(), isUncalibrated))
  {
    const cv::Size size(static_cast<int>(infos[reference].width), static_cast<int>(infos[reference].height));
    ArrayCalibration result = calibrationFromParameters(grid, reference, parameters, size);
    if (!result.calibration)
    {
      result.warnings = {
          "The CameraInfo of all " + std::to_string(infos.size()) +
          " views has a P of zeros, so there is disparity but no depth; calibrate the cameras, "
          "or set focal_length and baseline_x."};
    }
    return result;
  }
  checkInfos(grid, infos, reference);
  std::vector<cv::Point2d> positions = positionsFrom(infos, reference);
  const bool one_place = atOnePlace(positions);
  const bool no_baseline = one_place && !parameters.hasBaseline();
  if (one_place)
  {
    positions = no_baseline ? gridSteps(grid, reference) : positionsFrom(grid, reference, parameters);
  }

  ArrayCalibration result;
  const double baseline_m = adjacentBaseline(grid, positions);
  std::vector<cv::Point2d> steps;
  std::vector<cv::Point2d> shifts;
  for (std::size_t i = 0; i < grid.size(); ++i)
  {
    steps.push_back(positions[i] / baseline_m);
    shifts.push_back(principalPointOf(infos[i]) - principalPointOf(infos[reference]));
  }
  const double disparity_offset_px = fitDisparityOffset(steps, shifts);
  for (std::size_t i = 0; i < grid.size(); ++i)
  {
    result.views.push_back({steps[i], shifts[i] - disparity_offset_px * steps[i]});
  }
  if (no_baseline)
  {
    result.warnings.push_back(
        nameOf(grid[reference]) +
        " and all others: P[3] and P[7] of the CameraInfo place them at one point, so there is disparity but "
        "no depth; publish P[3] = -P[0] * (metres to the right) and P[7] = -P[5] * (metres down), or set "
        "baseline_x and baseline_y.");
    return result;
  }
  result.calibration.emplace();
  result.calibration->focal_length_px = infos[reference].P[FX];
  result.calibration->principal_point_px = principalPointOf(infos[reference]);
  result.calibration->baseline_m = baseline_m;
  result.calibration->disparity_offset_px = disparity_offset_px;

  const double row_baseline_m = rowBaseline(grid, positions).value_or(baseline_m);
  warnOfLargeBaseline(baseline_m,
                      one_place ? "baseline_x and baseline_y, which are in metres"
                                : "P[3] and P[7] of the CameraInfo, which are in pixels times metres",
                      result.warnings);
  if (!one_place)
  {
    warnOfOtherBaseline(parameters.baseline_x_m, baseline_m, "baseline_x", result.warnings);
    warnOfOtherBaseline(parameters.baseline_y_m, row_baseline_m, "baseline_y", result.warnings);
  }
  warnOfStrayViews(grid, reference, result.views, {1.0, row_baseline_m / baseline_m}, result.warnings);
  return result;
}

ArrayCalibration calibrationFromParameters(const std::vector<GridPosition>& grid, std::size_t reference,
                                           const CalibrationParameters& parameters,
                                           const cv::Size& image_size)
{
  checkCounts(grid.size(), grid.size(), reference);
  if (parameters.focal_length_px <= 0.0 && !parameters.hasBaseline())
  {
    return idealGrid(
        grid, reference,
        "Neither CameraInfo nor the parameters say what the cameras are, so there is disparity but "
        "no depth; set focal_length and baseline_x, or use the CameraInfo of the views.");
  }
  if (parameters.focal_length_px <= 0.0 || !parameters.hasBaseline())
  {
    throw InputError("Without CameraInfo, focal_length (" + number(parameters.focal_length_px) +
                     " px) and baseline_x (" + number(parameters.baseline_x_m) +
                     " m) must both be positive; set both, or neither for disparity without depth.");
  }
  const std::vector<cv::Point2d> positions = positionsFrom(grid, reference, parameters);
  ArrayCalibration result;
  result.calibration.emplace();
  result.calibration->focal_length_px = parameters.focal_length_px;
  result.calibration->principal_point_px = parameters.principal_point_px.value_or(
      cv::Point2d(0.5 * (image_size.width - 1), 0.5 * (image_size.height - 1)));
  result.calibration->baseline_m = adjacentBaseline(grid, positions);
  result.calibration->disparity_offset_px = parameters.disparity_offset_px;
  warnOfLargeBaseline(result.calibration->baseline_m, "baseline_x and baseline_y, which are in metres",
                      result.warnings);
  for (const cv::Point2d& position : positions)
  {
    result.views.push_back({position / result.calibration->baseline_m, {0.0, 0.0}});
  }
  return result;
}

sensor_msgs::CameraInfo cameraInfoFor(const View& view, const Calibration& calibration,
                                      const cv::Size& image_size)
{
  const double f = calibration.focal_length_px;
  const cv::Point2d c =
      calibration.principal_point_px + view.steps * calibration.disparity_offset_px + view.offset_px;
  const cv::Point2d position_m = view.steps * calibration.baseline_m;
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(image_size.width);
  info.height = static_cast<std::uint32_t>(image_size.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {f, 0.0, c.x, 0.0, f, c.y, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {f, 0.0, c.x, -f * position_m.x, 0.0, f, c.y, -f * position_m.y, 0.0, 0.0, 1.0, 0.0};
  return info;
}

}  // namespace light_field_depth
