#include <gtest/gtest.h>

#include "support/synthetic_scene.h"

namespace light_field_depth::testing
{
namespace
{
TEST(SyntheticScene, MovesPointsAgainstThePositionOfTheView)
{
  SceneSettings settings;
  settings.positions = gridPositions(3, 3);
  settings.samples = 1;
  const auto scene = renderScene({plane(2.0, 0, 0, noiseTexture(9))}, settings);
  const cv::Mat& reference = scene.light_field.reference().image;
  const cv::Mat& right = scene.light_field.views[5].image;
  const cv::Mat& below = scene.light_field.views[7].image;
  EXPECT_EQ(reference.at<cv::Vec3b>(40, 50), right.at<cv::Vec3b>(40, 48));
  EXPECT_EQ(reference.at<cv::Vec3b>(40, 50), below.at<cv::Vec3b>(38, 50));
}

TEST(SyntheticScene, ShowsTheNearestSurface)
{
  const cv::Size size(128, 96);
  const cv::Mat truth = renderTruth(standardScene(size), size, {0, 0});
  EXPECT_NEAR(truth.at<float>(40, 30), 1.3, 1e-6);
  EXPECT_LT(truth.at<float>(5, 5), -1.0);
  EXPECT_NEAR(truth.at<float>(52, 90), 2.0, 0.02);
}

TEST(SyntheticScene, TracesSlantedPlanesExactly)
{
  const cv::Size size(64, 48);
  const cv::Mat moved = renderTruth({plane(0.5, 0.02, -0.01, constantTexture({1, 2, 3}))}, size, {3, 0});
  // x' = x - 3 (0.5 + 0.02 x - 0.01 y)  =>  x = (x' + 1.5 - 0.03 y) / 0.94
  const double x = (20 + 1.5 - 0.03 * 10) / 0.94;
  EXPECT_NEAR(moved.at<float>(10, 20), 0.5 + 0.02 * x - 0.01 * 10, 1e-6);
}

}  // namespace
}  // namespace light_field_depth::testing
