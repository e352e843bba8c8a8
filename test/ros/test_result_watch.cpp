#include "ros/result_watch.h"

#include <gtest/gtest.h>

#include "light_field_depth/core/view_layout.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
testing::SyntheticLightField render()
{
  testing::SceneSettings settings;
  settings.positions = testing::crossPositions(5, 5);
  return testing::renderScene(testing::standardScene(settings.size), settings);
}

DisparityEstimate estimateOf(const cv::Mat& disparity)
{
  DisparityEstimate estimate;
  estimate.disparity = disparity;
  estimate.confidence = cv::Mat::ones(disparity.size(), CV_32FC1);
  estimate.range = {-2.0F, 3.0F};
  return estimate;
}

TEST(ResultWatch, LooksOnceASecondAndFindsNothingWrongWithARightResult)
{
  const testing::SyntheticLightField scene = render();
  ResultWatch watch(true);
  const ResultWatch::Time start;
  const auto first = watch.look(scene.light_field, estimateOf(scene.truth), start);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->empty()) << first->front();
  EXPECT_FALSE(
      watch.look(scene.light_field, estimateOf(scene.truth), start + std::chrono::milliseconds(999)));
  EXPECT_TRUE(
      watch.look(scene.light_field, estimateOf(scene.truth), start + std::chrono::milliseconds(1001)));
}

TEST(ResultWatch, AWrongOrderIsDoubtedUnlessNobodyAsks)
{
  const testing::SyntheticLightField scene = render();
  const LightField transposed = relabelled(scene.light_field, {false, false, true});
  ResultWatch watch(true);
  const auto doubts = watch.look(transposed, estimateOf(scene.truth), {});
  ASSERT_TRUE(doubts && !doubts->empty());
  EXPECT_NE(doubts->front().find("rows and columns"), std::string::npos) << doubts->front();
  ResultWatch careless(false);
  const auto others = careless.look(transposed, estimateOf(scene.truth), {});
  ASSERT_TRUE(others);
  for (const std::string& doubt : *others)
  {
    EXPECT_EQ(doubt.find("rows and columns are taken"), std::string::npos) << doubt;
  }
}

}  // namespace
}  // namespace light_field_depth
