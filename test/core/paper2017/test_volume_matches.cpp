#include "core/paper2017/volume_matches.h"

#include <gtest/gtest.h>

#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
constexpr double DISPARITY_PX = 1.5;

const LightField& cross()
{
  static const LightField rendered = []
  {
    testing::SceneSettings settings;
    settings.size = {96, 72};
    settings.positions = testing::crossPositions(3, 3);
    settings.samples = 1;
    return testing::renderScene({testing::plane(DISPARITY_PX, 0.0, 0.0, testing::noiseTexture(5, 16.0))},
                                settings)
        .light_field;
  }();
  return rendered;
}

double meanDisparity(const SparseDisparity& sparse)
{
  return cv::mean(sparse.disparity, sparse.confidence > 0.0F)[0];
}

TEST(VolumeMatches, EveryNeighbourIsMatchedBothWays)
{
  ThreadPool pool(2);
  RunContext context(pool);
  const std::vector<AngularVolume> volumes = extractVolumes(cross(), ViewSelection::Cross);
  ASSERT_EQ(volumes.size(), 2U);
  const std::vector<VolumeMatches> matches = matchVolumes(cross(), volumes, std::nullopt, {}, context);
  ASSERT_EQ(matches.size(), 2U);
  for (const VolumeMatches& of_volume : matches)
  {
    ASSERT_EQ(of_volume.forward.size(), 3U);
    ASSERT_EQ(of_volume.backward.size(), 3U);
    EXPECT_TRUE(of_volume.forward.back().disparity.empty());
    EXPECT_TRUE(of_volume.backward.front().disparity.empty());
    for (const std::size_t i : {0U, 1U})
    {
      EXPECT_GT(cv::countNonZero(of_volume.forward[i].confidence), 96 * 72 * 6 / 10);
      EXPECT_NEAR(meanDisparity(of_volume.forward[i]), DISPARITY_PX, 0.05);
      EXPECT_NEAR(meanDisparity(of_volume.backward[i + 1]), DISPARITY_PX, 0.05);
    }
  }
  ASSERT_EQ(context.stage_times.size(), 2U);
  EXPECT_EQ(context.stage_times[0].stage, "descriptors");
  EXPECT_EQ(context.stage_times[1].stage, "matching");
}

/// Mean disparity of the matches of a view with the next.
double meanOfInitializer(FlowInitializer initializer)
{
  ThreadPool pool(2);
  RunContext context(pool);
  Paper2017Options options;
  options.initializer = initializer;
  const auto matches = matchVolumes(cross(), extractVolumes(cross(), ViewSelection::Row),
                                    DisparityRange{0.0F, 3.0F}, options, context);
  EXPECT_GT(cv::countNonZero(matches.at(0).forward.at(1).confidence), 96 * 72 * 6 / 10);
  return meanDisparity(matches.at(0).forward.at(1));
}

TEST(VolumeMatches, OtherFlowsMatchEveryPixelWhereOpenCvHasThem)
{
  for (const auto initializer :
       {FlowInitializer::EpicFlow, FlowInitializer::DeepFlow, FlowInitializer::PcaFlow})
  {
    Paper2017Options options;
    options.initializer = initializer;
    const std::vector<std::string> problems = validate(options);
    if (problems.empty())
    {
      EXPECT_NEAR(meanOfInitializer(initializer), DISPARITY_PX, 0.1) << toString(initializer);
    }
    else
    {
      EXPECT_NE(problems.front().find("choose cpm or dis"), std::string::npos) << problems.front();
    }
  }
}

TEST(VolumeMatches, DisMatchesEveryPixel)
{
  ThreadPool pool(2);
  RunContext context(pool);
  Paper2017Options options;
  options.initializer = FlowInitializer::Dis;
  const std::vector<VolumeMatches> matches = matchVolumes(
      cross(), extractVolumes(cross(), ViewSelection::Row), DisparityRange{0.0F, 3.0F}, options, context);
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_NEAR(meanDisparity(matches[0].forward[1]), DISPARITY_PX, 0.1);
  double least = 0.0;
  double most = 0.0;
  cv::minMaxIdx(matches[0].forward[1].disparity, &least, &most);
  EXPECT_GE(least, 0.0);
  EXPECT_LE(most, 3.0);
  ASSERT_EQ(context.stage_times.size(), 1U) << "no descriptors";
}

}  // namespace
}  // namespace light_field_depth
