#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "core/light_field/half_resolution.h"
#include "support/synthetic_scene.h"

namespace light_field_depth::multiview
{
namespace
{
TEST(HalfResolution, KeepsColoursAndLeavesOddEndsOut)
{
  for (const int type : {CV_8UC1, CV_8UC3})
  {
    const cv::Size size(203, 41);
    cv::Mat image(size, type);
    cv::RNG random(6);
    random.fill(image, cv::RNG::UNIFORM, 0, 256);
    cv::Mat half;
    halveChannels(image, half);
    cv::Mat expected;
    cv::resize(image(cv::Rect(0, 0, 202, 40)), expected, cv::Size(101, 20), 0, 0, cv::INTER_AREA);
    ASSERT_EQ(half.size(), expected.size());
    EXPECT_EQ(cv::norm(half, expected, cv::NORM_INF), 0.0);
  }
}

TEST(HalfResolution, IsTheMeanBrightnessOfFourPixels)
{
  auto settings = testing::SceneSettings();
  settings.positions = testing::crossPositions(3, 3);
  settings.size = {75, 41};
  const auto input = testing::renderScene(testing::standardScene(settings.size), settings);
  ThreadPool pool(2);
  HalfResolution reducer;
  const LightField& half = reducer.reduce(input.light_field, pool);
  ASSERT_EQ(half.views.size(), input.light_field.views.size());
  for (std::size_t i = 0; i < half.views.size(); ++i)
  {
    const View& view = input.light_field.views[i];
    cv::Mat grey;
    cv::Mat expected;
    cv::cvtColor(view.image, grey, cv::COLOR_BGR2GRAY);
    cv::resize(grey(cv::Rect(0, 0, 74, 40)), expected, {37, 20}, 0, 0, cv::INTER_AREA);
    EXPECT_LE(cv::norm(half.views[i].image, expected, cv::NORM_INF), 1.0);
    EXPECT_EQ(half.views[i].steps, 0.5 * view.steps);
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
