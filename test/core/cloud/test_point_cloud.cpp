#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include <gtest/gtest.h>

#include "light_field_depth/core/geometry.h"
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

std::vector<ViewDisparity> constantMaps(const LightField& field, float disparity)
{
  std::vector<ViewDisparity> maps;
  for (std::size_t i = 0; i < field.views.size(); ++i)
  {
    maps.push_back(
        {i, cv::Mat(field.size(), CV_32FC1, cv::Scalar(disparity)), cv::Mat::ones(field.size(), CV_32FC1)});
  }
  return maps;
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

TEST(PointCloud, KeepsTheColourOfAVoxelThatHoldsManyPoints)
{
  testing::SyntheticLightField scene = planeScene(0.0);
  scene.light_field.views[0].image = cv::Mat(512, 512, CV_8UC3, cv::Scalar(255, 254, 1));
  const cv::Mat disparity(512, 512, CV_32FC1, cv::Scalar(1.0));
  constexpr int maps_of_one_view = 80;  // 21 million points, whose levels add up to more than 32 bits
  const std::vector<ViewDisparity> maps(maps_of_one_view, {0, disparity, cv::Mat()});
  DenseCloudOptions options;
  options.voxel_size_m = 1e6F;
  options.min_confidence = 0.0F;
  ThreadPool pool(2);
  const std::vector<ColoredPoint> cloud = denseCloud(scene.light_field, maps, options, pool);
  ASSERT_FALSE(cloud.empty());
  for (const ColoredPoint& point : cloud)
  {
    EXPECT_EQ(cv::Vec3b(point.b, point.g, point.r), cv::Vec3b(255, 254, 1));
  }
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

TEST(PointCloud, PutsThePointsOfAllViewsOnOneSurface)
{
  // With disparity 1.5 and integer steps of 2 views, the same surface point must come out of both cameras.
  const auto scene = planeScene(2.0);
  ThreadPool pool(2);
  const auto cloud = denseCloud(scene.light_field, constantMaps(scene.light_field, 2.0F), {}, pool);
  ASSERT_EQ(cloud.size(), 9U * 64 * 48);
  const auto at = [&](int view, int y, int x)
  { return cloud[static_cast<std::size_t>((view * 48 + y) * 64 + x)]; };
  // View 5 stands one step to the right of the reference (view 4): the point moves by -2 px there.
  const ColoredPoint a = at(4, 20, 30);
  const ColoredPoint b = at(5, 20, 28);
  EXPECT_NEAR(a.x, b.x, 1e-5);
  EXPECT_NEAR(a.y, b.y, 1e-5);
  EXPECT_NEAR(a.z, b.z, 1e-5);
  EXPECT_NEAR(a.g, b.g, 2);
  const ColoredPoint c = at(7, 18, 30);  // one step down
  EXPECT_NEAR(a.x, c.x, 1e-5);
  EXPECT_NEAR(a.y, c.y, 1e-5);
}

TEST(PointCloud, LeavesOutWhatHasNoDepthAndMergesVoxels)
{
  const auto scene = planeScene(0.0);
  auto maps = constantMaps(scene.light_field, 0.0F);
  maps[0].disparity.at<float>(0, 0) = std::nanf("");
  maps[1].confidence.setTo(0.0F);
  ThreadPool pool(2);
  DenseCloudOptions options;
  const auto cloud = denseCloud(scene.light_field, maps, options, pool);
  EXPECT_EQ(cloud.size(), 8U * 64 * 48 - 1);
  options.voxel_size_m = 0.1F;
  const auto merged = denseCloud(scene.light_field, maps, options, pool);
  EXPECT_LT(merged.size(), cloud.size() / 8);
  for (const ColoredPoint& point : merged)
  {
    EXPECT_NEAR(point.z, 2.0F, 1e-5);
  }
}

TEST(PointCloud, MergesVoxelsIntoTheMeansOfTheirPointsForAnyNumberOfThreads)
{
  const auto scene = planeScene(0.0);
  auto maps = constantMaps(scene.light_field, 0.0F);
  for (ViewDisparity& map : maps)
  {
    cv::randu(map.disparity, -1.0F, 3.0F);
  }
  ThreadPool one(1);
  ThreadPool three(3);
  DenseCloudOptions options;
  const auto cloud = denseCloud(scene.light_field, maps, options, one);
  options.voxel_size_m = 0.1F;
  const auto merged = denseCloud(scene.light_field, maps, options, one);

  using Key = std::array<int, 3>;
  const auto keyOf = [&](const ColoredPoint& point)
  {
    const auto cell = [&](float position)
    { return static_cast<int>(std::floor(position * (1.0 / options.voxel_size_m))); };
    return Key{cell(point.x), cell(point.y), cell(point.z)};
  };
  std::map<Key, std::vector<ColoredPoint>> expected;
  for (const ColoredPoint& point : cloud)
  {
    expected[keyOf(point)].push_back(point);
  }
  ASSERT_EQ(merged.size(), expected.size());
  const auto mean = [](const std::vector<ColoredPoint>& points, const auto& value)
  {
    double sum = 0.0;
    for (const ColoredPoint& point : points)
    {
      sum += value(point);
    }
    return sum / static_cast<double>(points.size());
  };
  std::size_t found = 0;
  for (const ColoredPoint& point : merged)
  {
    const auto voxel = expected.find(keyOf(point));
    if (voxel == expected.end())
    {
      continue;  // a mean on the face of its cube, rounded out of it
    }
    ++found;
    EXPECT_NEAR(point.x, mean(voxel->second, [](const auto& p) { return p.x; }), 1e-5);
    EXPECT_NEAR(point.z, mean(voxel->second, [](const auto& p) { return p.z; }), 1e-5);
    EXPECT_NEAR(point.g, mean(voxel->second, [](const auto& p) { return p.g; }), 0.51);
  }
  EXPECT_GT(found, expected.size() * 99 / 100);

  const auto on_three = denseCloud(scene.light_field, maps, options, three);
  ASSERT_EQ(on_three.size(), merged.size());
  EXPECT_EQ(std::memcmp(on_three.data(), merged.data(), merged.size() * sizeof(ColoredPoint)), 0);
  options.voxel_size_m = 0.0F;
  const auto all_on_three = denseCloud(scene.light_field, maps, options, three);
  ASSERT_EQ(all_on_three.size(), cloud.size());
  EXPECT_EQ(std::memcmp(all_on_three.data(), cloud.data(), cloud.size() * sizeof(ColoredPoint)), 0);
}

TEST(PointCloud, RefusesSettingsThatMeanNothing)
{
  DenseCloudOptions options;
  options.voxel_size_m = -1.0F;
  options.min_confidence = std::nanf("");
  EXPECT_EQ(validate(options).size(), 2U);
  EXPECT_TRUE(validate(DenseCloudOptions{}).empty());
}

}  // namespace
}  // namespace light_field_depth
