#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "light_field_depth/core/point_cloud.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
Calibration shearedCalibration()
{
  Calibration calibration;
  calibration.focal_length_px = 100.0;
  calibration.principal_point_px = {31.5, 23.5};
  calibration.baseline_m = 0.1;
  calibration.disparity_offset_px = 5.0;
  return calibration;
}

testing::SyntheticLightField planeScene(double disparity)
{
  testing::SceneSettings settings;
  settings.size = {64, 48};
  settings.positions = testing::gridPositions(3, 3);
  settings.samples = 1;
  settings.calibration = shearedCalibration();
  return testing::renderScene({testing::plane(disparity, 0, 0, testing::noiseTexture(5))}, settings);
}

TEST(PointCloud, UnprojectsTheReferenceViewWithItsPrincipalPoint)
{
  const auto scene = planeScene(0.0);
  ThreadPool pool(2);
  std::vector<ColoredPoint> points(64 * 48);
  unprojectReference(scene.light_field, scene.truth, cv::Mat(), 0.0F, pool, points.data());
  const ColoredPoint& point = points[20 * 64 + 40];
  EXPECT_NEAR(point.z, 100.0 * 0.1 / 5.0, 1e-5);
  EXPECT_NEAR(point.x, (40 - 31.5) * 2.0 / 100.0, 1e-5);
  EXPECT_NEAR(point.y, (20 - 23.5) * 2.0 / 100.0, 1e-5);
  const auto& color = scene.light_field.reference().image.at<cv::Vec3b>(20, 40);
  EXPECT_EQ(cv::Vec3b(point.b, point.g, point.r), color);
}

TEST(PointCloud, HasNanWhereTheConfidenceIsTooLow)
{
  const auto scene = planeScene(0.0);
  cv::Mat confidence = cv::Mat::ones(scene.truth.size(), CV_32FC1);
  confidence.at<float>(3, 4) = 0.2F;
  ThreadPool pool(1);
  std::vector<ColoredPoint> points(64 * 48);
  unprojectReference(scene.light_field, scene.truth, confidence, 0.5F, pool, points.data());
  EXPECT_TRUE(std::isnan(points[3 * 64 + 4].x));
  EXPECT_TRUE(std::isnan(points[3 * 64 + 4].z));
  EXPECT_FALSE(std::isnan(points[3 * 64 + 5].z));
}

}  // namespace
}  // namespace light_field_depth
