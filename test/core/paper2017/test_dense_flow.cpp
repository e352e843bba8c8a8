#include "core/paper2017/dense_flow.h"

#include <gtest/gtest.h>

#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
constexpr double DISPARITY_PX = 1.5;
constexpr int SPACING_PX = 3;

const LightField& row()
{
  static const LightField rendered = []
  {
    testing::SceneSettings settings;
    settings.size = {96, 72};
    settings.positions = testing::gridPositions(1, 3);
    settings.samples = 1;
    return testing::renderScene({testing::plane(DISPARITY_PX, 0.0, 0.0, testing::noiseTexture(5, 16.0))},
                                settings)
        .light_field;
  }();
  return rendered;
}

/// Without the border, whose pixels the next view may not show.
double meanOf(const SeedMatches& matches)
{
  EXPECT_EQ(matches.disparity.size(), row().size());
  EXPECT_EQ(matches.columns_px.size(), 96U);
  EXPECT_EQ(matches.rows_px.back(), 71);
  return cv::mean(matches.disparity(cv::Rect(12, 12, 72, 48)))[0];
}

TEST(DenseFlow, EveryMethodThatOpenCvHasMatchesEveryPixel)
{
  for (const auto initializer : {FlowInitializer::Dis, FlowInitializer::DeepFlow, FlowInitializer::PcaFlow})
  {
    if (!whatIsMissingFor(initializer))
    {
      const SeedMatches matches = matchByFlow(row().views[1], row().views[2], initializer, std::nullopt);
      EXPECT_NEAR(meanOf(matches), DISPARITY_PX, 0.1) << toString(initializer);
    }
  }
  const SeedMatches limited =
      matchByFlow(row().views[1], row().views[2], FlowInitializer::Dis, DisparityRange{0.0F, 1.0F});
  EXPECT_LE(meanOf(limited), 1.0);
}

TEST(DenseFlow, EpicFlowSpreadsSparseMatches)
{
  if (whatIsMissingFor(FlowInitializer::EpicFlow))
  {
    GTEST_SKIP() << *whatIsMissingFor(FlowInitializer::EpicFlow);
  }
  SparseDisparity sparse;
  sparse.disparity = cv::Mat(row().size(), CV_32FC1);
  cv::RNG(3).fill(sparse.disparity, cv::RNG::NORMAL, DISPARITY_PX, 0.02);  // OpenCV wants some error
  sparse.confidence = cv::Mat::zeros(row().size(), CV_32FC1);
  sparse.confidence(cv::Rect(20, 20, 40, 30)).setTo(1.0);
  const auto spread = [&]
  { return spreadByEpicFlow(row().views[1], row().views[2], sparse, SPACING_PX, std::nullopt); };
  EXPECT_NEAR(meanOf(spread()), DISPARITY_PX, 0.03);
  sparse.confidence.setTo(0.0);
  EXPECT_EQ(meanOf(spread()), 0.0) << "nothing to spread";
}

TEST(DenseFlow, TellsWhatOpenCvLacks)
{
  EXPECT_FALSE(whatIsMissingFor(FlowInitializer::Cpm).has_value());
  EXPECT_FALSE(whatIsMissingFor(FlowInitializer::Dis).has_value());
  for (const auto initializer :
       {FlowInitializer::EpicFlow, FlowInitializer::DeepFlow, FlowInitializer::PcaFlow})
  {
    Paper2017Options options;
    options.initializer = initializer;
    const std::optional<std::string> missing = whatIsMissingFor(initializer);
    const std::vector<std::string> problems = validate(options);
    ASSERT_EQ(problems.size(), missing ? 1U : 0U);
    if (missing)
    {
      EXPECT_EQ(problems.front(), *missing);
      EXPECT_NE(missing->find("choose cpm or dis"), std::string::npos) << *missing;
    }
  }
}

}  // namespace
}  // namespace light_field_depth
