#include "evaluation/surface_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace light_field_depth
{
namespace
{
std::vector<cv::Point3f> randomPoints(int count, std::uint64_t seed)
{
  cv::RNG random(seed);
  std::vector<cv::Point3f> points;
  for (int i = 0; i < count; ++i)
  {
    points.emplace_back(random.uniform(-1.0F, 1.0F), random.uniform(-0.7F, 0.7F), random.uniform(0.0F, 0.3F));
  }
  return points;
}

TEST(SurfaceIndex, ProjectiveCoordinatesAreRaysAndTheLogarithmOfDepth)
{
  const cv::Point3f point = projective({2.0F, -1.0F, 4.0F});
  EXPECT_FLOAT_EQ(point.x, 0.5F);
  EXPECT_FLOAT_EQ(point.y, -0.25F);
  EXPECT_FLOAT_EQ(point.z, std::log(4.0F));
}

TEST(SurfaceIndex, FindsTheNearestPointForBinsOfAnySize)
{
  const std::vector<cv::Point3f> points = randomPoints(400, 3);
  for (const float bin_size : {0.003F, 0.05F, 5.0F})
  {
    const SurfaceIndex index(points, bin_size);
    for (const cv::Point3f& query : randomPoints(60, 4))
    {
      float nearest = 10.0F;
      for (const cv::Point3f& point : points)
      {
        nearest = std::min(nearest, static_cast<float>(cv::norm(point - query)));
      }
      EXPECT_NEAR(index.distance(query, 10.0F), nearest, 1e-5F) << bin_size;
      EXPECT_NEAR(index.distance(query, 0.05F), std::min(nearest, 0.05F), 1e-5F) << bin_size;
    }
  }
}

TEST(SurfaceIndex, FarOutsideIsTheLimit)
{
  const SurfaceIndex index({{0.0F, 0.0F, 0.0F}}, 0.01F);
  EXPECT_FLOAT_EQ(index.distance({100.0F, 0.0F, 0.0F}, 0.5F), 0.5F);
  EXPECT_FLOAT_EQ(index.distance({0.2F, 0.0F, 0.0F}, 0.5F), 0.2F);
  EXPECT_FLOAT_EQ(index.distance({1e30F, -1e30F, 0.0F}, 0.5F), 0.5F);
}

TEST(SurfaceIndex, AStrayPointDoesNotAskForAllMemory)
{
  std::vector<cv::Point3f> points = randomPoints(100, 5);
  points.emplace_back(1e6F, 0.0F, 0.0F);
  const SurfaceIndex index(points, 1e-3F);
  EXPECT_NEAR(index.distance(points[7], 1.0F), 0.0F, 1e-6F);
}

}  // namespace
}  // namespace light_field_depth
