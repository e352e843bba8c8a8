#include "light_field_depth/ros/calibration_from_camera_info.h"

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "expect_sentence.h"
#include "light_field_depth/core/geometry.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
using testing::expectSentence;

const cv::Size SIZE(640, 480);

/// An array with irregular positions and principal points, sheared onto a focus plane.
struct Array
{
  std::vector<GridPosition> grid = testing::gridPositions(3, 3);
  std::size_t reference = 4;
  std::vector<sensor_msgs::CameraInfo> infos;
};

Array regularArray(double disparity_offset_px = 2.5)
{
  Array array;
  Calibration calibration;
  calibration.focal_length_px = 500.0;
  calibration.principal_point_px = {320.5, 239.0};
  calibration.baseline_m = 0.05;
  calibration.disparity_offset_px = disparity_offset_px;
  for (const GridPosition& position : array.grid)
  {
    View view = gridView(position.row, position.column, {});
    view.steps -= cv::Point2d(1, 1);
    array.infos.push_back(cameraInfoFor(view, calibration, SIZE));
  }
  return array;
}

ArrayCalibration calibrate(const Array& array, const CalibrationParameters& parameters = {})
{
  return calibrationFromCameraInfo(array.grid, array.infos, array.reference, parameters);
}

void expectNear(const cv::Point2d& actual, const cv::Point2d& expected, double tolerance)
{
  EXPECT_NEAR(actual.x, expected.x, tolerance);
  EXPECT_NEAR(actual.y, expected.y, tolerance);
}

TEST(CalibrationFromCameraInfo, IsTheInverseOfCameraInfoFor)
{
  const Array array = regularArray();
  const ArrayCalibration result = calibrate(array);
  EXPECT_DOUBLE_EQ(result.calibration->focal_length_px, 500.0);
  EXPECT_NEAR(result.calibration->baseline_m, 0.05, 1e-12);
  EXPECT_NEAR(result.calibration->disparity_offset_px, 2.5, 1e-9);
  expectNear(result.calibration->principal_point_px, {320.5, 239.0}, 1e-9);
  for (std::size_t i = 0; i < array.grid.size(); ++i)
  {
    expectNear(result.views[i].steps, cv::Point2d(array.grid[i].column - 1, array.grid[i].row - 1), 1e-9);
    expectNear(result.views[i].offset_px, {0.0, 0.0}, 1e-9);
  }
  EXPECT_TRUE(result.warnings.empty());
}

/// Projects a point with the P of CameraInfo's definition.
cv::Point2d project(const sensor_msgs::CameraInfo& info, double x, double y, double z)
{
  const double w = info.P[8] * x + info.P[9] * y + info.P[10] * z + info.P[11];
  return {(info.P[0] * x + info.P[1] * y + info.P[2] * z + info.P[3]) / w,
          (info.P[4] * x + info.P[5] * y + info.P[6] * z + info.P[7]) / w};
}

TEST(CalibrationFromCameraInfo, ExplainsWhereEveryViewSeesAPoint)
{
  Array array = regularArray();
  cv::RNG random(5);
  for (sensor_msgs::CameraInfo& info : array.infos)
  {
    info.P[2] += random.gaussian(1.5);
    info.P[6] += random.gaussian(1.5);
    info.P[3] += random.gaussian(1.0);
    info.P[7] += random.gaussian(1.0);
  }
  array.infos[array.reference] = regularArray().infos[array.reference];
  const ArrayCalibration result = calibrate(array);
  const cv::Point3d point(0.3, -0.2, 2.0);
  const double d = disparityFromDepth(static_cast<float>(point.z), *result.calibration);
  const cv::Point2d p = project(array.infos[array.reference], point.x, point.y, point.z);
  for (std::size_t i = 0; i < array.grid.size(); ++i)
  {
    // The model of View: p - d * steps + offset.
    expectNear(p - d * result.views[i].steps + result.views[i].offset_px,
               project(array.infos[i], point.x, point.y, point.z), 1e-5);
  }
}

TEST(CalibrationFromCameraInfo, HasAPositiveOffsetForALightFieldInFocusAtADistance)
{
  // HCI: principal points move so that a point of the focus plane is at the same pixel in all views.
  constexpr double FOCUS_M = 4.0;
  Array array = regularArray(0.0);
  for (sensor_msgs::CameraInfo& info : array.infos)
  {
    info.P[2] += -info.P[3] / FOCUS_M;  // f B / F
    info.P[6] += -info.P[7] / FOCUS_M;
  }
  const ArrayCalibration result = calibrate(array);
  EXPECT_NEAR(result.calibration->disparity_offset_px, 500.0 * 0.05 / FOCUS_M, 1e-9);
  EXPECT_NEAR(depthFromDisparity(0.0F, *result.calibration), FOCUS_M, 1e-5);
  const cv::Point2d in_reference = project(array.infos[4], 0.1, 0.1, FOCUS_M);
  expectNear(project(array.infos[0], 0.1, 0.1, FOCUS_M), in_reference, 1e-9);
}

TEST(CalibrationFromCameraInfo, TakesRowsAndColumnsWithDifferentBaselines)
{
  Array array = regularArray();
  for (sensor_msgs::CameraInfo& info : array.infos)
  {
    info.P[7] *= 2.0;
  }
  const ArrayCalibration result = calibrate(array);
  EXPECT_NEAR(result.calibration->baseline_m, 0.05, 1e-12);
  expectNear(result.views[0].steps, {-1.0, -2.0}, 1e-9);
  EXPECT_TRUE(result.warnings.empty());
}

TEST(CalibrationFromCameraInfo, WorksOnASingleColumnAndOnSparseGrids)
{
  const Array full = regularArray();
  Array column;
  column.grid = {{0, 0}, {2, 0}};
  column.infos = {full.infos[1], full.infos[7]};
  column.reference = 0;
  const ArrayCalibration result = calibrate(column);
  EXPECT_NEAR(result.calibration->baseline_m, 0.05, 1e-12);
  expectNear(result.views[1].steps, {0.0, 2.0}, 1e-9);
}

TEST(CalibrationFromCameraInfo, TakesABaselineFromTheParametersOnlyWhereNoPHasOne)
{
  CalibrationParameters parameters;
  parameters.baseline_x_m = 0.2;
  Array monocular = regularArray();
  for (sensor_msgs::CameraInfo& info : monocular.infos)
  {
    info.P[3] = 0.0;
    info.P[7] = 0.0;
  }
  EXPECT_NEAR(calibrate(monocular, parameters).calibration->baseline_m, 0.2, 1e-12);
  const ArrayCalibration with_both = calibrate(regularArray(), parameters);
  EXPECT_NEAR(with_both.calibration->baseline_m, 0.05, 1e-12);
  ASSERT_EQ(with_both.warnings.size(), 1U);
  EXPECT_NE(with_both.warnings[0].find("baseline_x is 0.2 m"), std::string::npos);
}

TEST(CalibrationFromCameraInfo, WarnsOfAViewFarFromItsPlace)
{
  Array array = regularArray();
  array.infos[8].P[7] *= 1.9;
  const ArrayCalibration result = calibrate(array);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].find("View (2, 2)"), std::string::npos);
}

TEST(CalibrationFromCameraInfo, WarnsOfABaselineInMillimetres)
{
  Array array = regularArray();
  for (sensor_msgs::CameraInfo& info : array.infos)
  {
    info.P[3] *= 1000.0;
    info.P[7] *= 1000.0;
  }
  const ArrayCalibration result = calibrate(array);
  ASSERT_EQ(result.warnings.size(), 1U);
  for (const char* const part : {"50 m apart", "P[3]", "pixels times metres", "50 mm"})
  {
    EXPECT_NE(result.warnings[0].find(part), std::string::npos) << result.warnings[0];
  }
}

TEST(CalibrationFromCameraInfo, NamesViewFieldAndRemedyOfWhatCannotBeUsed)
{
  const auto expect = [](const std::function<void(Array&)>& spoil, const std::vector<std::string>& parts)
  {
    Array array = regularArray();
    spoil(array);
    expectSentence([&] { calibrate(array); }, parts);
  };
  expect([](Array& array) { array.infos[3].P[0] = 0.0; }, {"View (1, 0)", "P[0]", "is 0", "calibrate"});
  expect([](Array& array) { array.infos[3].P[5] = -2.0; }, {"View (1, 0)", "P[5]", "-2"});
  expect([](Array& array) { array.infos[2].P[3] = std::numeric_limits<double>::quiet_NaN(); },
         {"View (0, 2)", "P[3]", "nan"});
  expect([](Array& array) { array.infos[6].P[0] = 510.0; }, {"View (2, 0)", "P[0]", "510", "500", "rectify"});
  expect([](Array& array) { array.infos[6].P[5] = 510.0; }, {"View (2, 0)", "P[5]", "510", "square pixels"});
  expect([](Array& array) { array.infos[1].width = 320; }, {"View (0, 1)", "320 x 480", "640 x 480"});
  expect([](Array& array) { std::swap(array.infos[0], array.infos[2]); },
         {"View (0, 1)", "-P[3] / P[0]", "column", "from left to right"});
  expect([](Array& array) { std::swap(array.infos[0], array.infos[6]); },
         {"View (1, 0)", "-P[7] / P[5]", "row", "from top to bottom"});
  expect([](Array& array) { array.infos.pop_back(); }, {"9 views", "8 CameraInfo"});
}

TEST(CalibrationFromCameraInfo, GivesNoDepthButSaysSoWithoutABaseline)
{
  Array array = regularArray();
  for (sensor_msgs::CameraInfo& info : array.infos)
  {
    info.P[3] = info.P[7] = 0.0;
  }
  const ArrayCalibration result = calibrate(array);
  EXPECT_FALSE(result.calibration);
  expectNear(result.views[8].steps, {1.0, 1.0}, 1e-12);
  ASSERT_EQ(result.warnings.size(), 1U);
  for (const char* const part : {"View (1, 1)", "P[3]", "P[7]", "no depth", "baseline_x"})
  {
    EXPECT_NE(result.warnings[0].find(part), std::string::npos) << result.warnings[0];
  }
}

TEST(CalibrationFromCameraInfo, TakesParametersWhereEveryPIsZero)
{
  Array array = regularArray();
  for (sensor_msgs::CameraInfo& info : array.infos)
  {
    info.P.fill(0.0);
  }
  const ArrayCalibration without = calibrate(array);
  EXPECT_FALSE(without.calibration);
  expectNear(without.views[0].steps, {-1.0, -1.0}, 1e-12);
  ASSERT_EQ(without.warnings.size(), 1U);
  EXPECT_NE(without.warnings[0].find("P of zeros"), std::string::npos);
  CalibrationParameters parameters;
  parameters.focal_length_px = 300.0;
  parameters.baseline_x_m = 0.1;
  EXPECT_DOUBLE_EQ(calibrate(array, parameters).calibration->focal_length_px, 300.0);
}

TEST(CalibrationFromParameters, MakesAnIdealGrid)
{
  CalibrationParameters parameters;
  parameters.baseline_x_m = 0.1;
  parameters.baseline_y_m = 0.05;
  parameters.focal_length_px = 300.0;
  parameters.disparity_offset_px = 1.0;
  const ArrayCalibration result =
      calibrationFromParameters(testing::gridPositions(3, 3), 4, parameters, SIZE);
  expectNear(result.calibration->principal_point_px, {319.5, 239.5}, 1e-12);
  expectNear(result.views[8].steps, {1.0, 0.5}, 1e-12);
  EXPECT_DOUBLE_EQ(result.calibration->disparity_offset_px, 1.0);
}

TEST(CalibrationFromParameters, RefusesWhatIsMissingOrNotFinite)
{
  CalibrationParameters parameters;
  const ArrayCalibration nothing_given =
      calibrationFromParameters(testing::gridPositions(1, 2), 0, parameters, SIZE);
  EXPECT_FALSE(nothing_given.calibration) << "disparity only";
  EXPECT_EQ(nothing_given.warnings.size(), 1U);
  parameters.focal_length_px = 300.0;
  expectSentence([&] { calibrationFromParameters(testing::gridPositions(1, 2), 0, parameters, SIZE); },
                 {"focal_length", "baseline_x"});
  parameters.baseline_x_m = -1.0;
  parameters.disparity_offset_px = std::numeric_limits<double>::infinity();
  EXPECT_EQ(validate(parameters).size(), 2U);
}

}  // namespace
}  // namespace light_field_depth
