#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/sequence.h"

namespace light_field_depth::multiview
{
namespace
{
LightField row(int views, const cv::Size& size = {32, 24})
{
  std::vector<View> list;
  for (int i = 0; i < views; ++i)
  {
    list.push_back(gridView(0, i, cv::Mat(size, CV_8UC1, 100)));
  }
  return makeLightField(std::move(list));
}

TEST(Sequence, AFrameFollowsOneThatCameToItsEnd)
{
  Sequence sequence;
  EXPECT_EQ(sequence.follow(row(3), {}), nullptr);
  SceneMeasures measures;
  measures.noise_sigma = 2.5F;
  sequence.begin(measures);
  const SceneMeasures* const followed = sequence.follow(row(3), {});
  ASSERT_NE(followed, nullptr);
  EXPECT_EQ(followed->noise_sigma, 2.5F);
}

TEST(Sequence, AFrameThatDidNotEndBreaksIt)
{
  Sequence sequence;
  sequence.follow(row(3), {});
  sequence.begin({});
  EXPECT_NE(sequence.follow(row(3), {}), nullptr);
  EXPECT_EQ(sequence.follow(row(3), {}), nullptr);  // keep() was not called
}

TEST(Sequence, OtherViewsOrSettingsBeginAnew)
{
  FrameSettings other_options;
  other_options.options.refinements = 1;
  FrameSettings other_range;
  other_range.disparity_range = DisparityRange{0.0F, 1.0F};
  const std::vector<std::pair<LightField, FrameSettings>> others = {
      {row(4), {}}, {row(3, {32, 25}), {}}, {row(3), other_options}, {row(3), other_range}};
  for (const auto& [light_field, settings] : others)
  {
    Sequence sequence;
    sequence.follow(row(3), {});
    sequence.begin({});
    EXPECT_EQ(sequence.follow(light_field, settings), nullptr);
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
