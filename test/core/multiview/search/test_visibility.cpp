#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/search/visibility.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int WIDTH = 60;
constexpr int HEIGHT = 24;
constexpr LabelSpace LABELS{0.0F, 0.5F, 9};  // 0 .. 4

TEST(VisibleSurfaces, TheNearestIsInFrontAndNothingIsKnownBehindIt)
{
  std::vector<View> views = {gridView(0, 0, cv::Mat(HEIGHT, WIDTH, CV_8UC1, 100)),
                             gridView(0, 1, cv::Mat(HEIGHT, WIDTH, CV_8UC1, 100))};
  const LightField light_field = makeLightField(std::move(views), GridPosition{0, 0});
  ViewSetSettings settings;
  settings.range = {0.0F, 4.0F};
  ThreadPool pool(2);
  ViewSet view_set;
  prepareViews(light_field, settings, pool, view_set);
  cv::Mat disparity(HEIGHT, WIDTH, CV_32FC1, 0.0F);
  disparity.colRange(20, 40).setTo(4.0F);
  VisibleSurfaces surfaces;
  surfaces.warp(disparity, view_set, LABELS, pool);
  const std::uint8_t* const row = surfaces.row(0, 12);
  const auto background = static_cast<std::uint8_t>(VISIBILITY_BIAS);
  const auto object = static_cast<std::uint8_t>(8 + VISIBILITY_BIAS);
  EXPECT_EQ(row[10], background);
  EXPECT_EQ(row[16], object);  // column 20 moves by 4 to the left
  EXPECT_EQ(row[35], object);
  EXPECT_EQ(row[38], NO_SURFACE);  // what the reference does not see
  EXPECT_EQ(row[45], background);
  EXPECT_EQ(row[-1], OUT_OF_FRAME);
  EXPECT_EQ(surfaces.row(0, HEIGHT)[10], OUT_OF_FRAME);
}

}  // namespace
}  // namespace light_field_depth::multiview
