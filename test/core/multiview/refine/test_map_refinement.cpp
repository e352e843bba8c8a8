#include <gtest/gtest.h>

#include "core/multiview/refine/map_refinement.h"
#include "support/synthetic_scene.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr float DISPARITY_PX = 0.6F;
const DisparityRange RANGE = {-1.0F, 2.0F};

/// A textured wall across the line of sight.
class MapRefinementTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    testing::SceneSettings settings;
    settings.size = {128, 80};
    settings.positions = testing::crossPositions(5, 5);
    const LightField light_field =
        testing::renderScene({testing::plane(DISPARITY_PX, 0.0, 0.0, testing::noiseTexture(3, 10.0))},
                             settings)
            .light_field;
    ViewSetSettings view_settings;
    view_settings.range = RANGE;
    prepareViews(light_field, view_settings, pool_, views_);
  }

  cv::Mat refined(float start_px, const RefinementSettings& settings)
  {
    const cv::Mat start(views_.height(), views_.width(), CV_32FC1, cv::Scalar(start_px));
    cv::Mat disparity;
    refinement_.run({views_, views_.reference, RANGE}, settings, start, context_, disparity);
    return disparity;
  }

  static double meanError(const cv::Mat& disparity)
  {
    return cv::norm(disparity, cv::Mat(disparity.size(), CV_32FC1, cv::Scalar(DISPARITY_PX)), cv::NORM_L1) /
           static_cast<double>(disparity.total());
  }

  ThreadPool pool_{2};
  RunContext context_{pool_};
  ViewSet views_;
  MapRefinement refinement_;
};

TEST_F(MapRefinementTest, OfHalfALabelLessThanAQuarterIsLeft)
{
  EXPECT_LT(meanError(refined(DISPARITY_PX + 0.06F, {})), 0.015);
}

TEST_F(MapRefinementTest, WithoutARefinementTheMapStaysAndIsLinearizedForTheConfidence)
{
  RefinementSettings settings;
  settings.refinements = 0;
  const cv::Mat map = refined(DISPARITY_PX + 0.06F, settings);
  EXPECT_NEAR(meanError(map), 0.06, 1e-6);
  EXPECT_EQ(refinement_.linearization().weight.size(), map.size());
  EXPECT_EQ(cv::norm(refinement_.linearization().weight - refinement_.linearization().weight, cv::NORM_INF),
            0.0)
      << "finite";
}

TEST_F(MapRefinementTest, TheResultIsInReachOfTheRange)
{
  const cv::Mat map = refined(RANGE.max, {});
  EXPECT_TRUE(cv::checkRange(map, true, nullptr, RANGE.min - 1.0, RANGE.max + 1.0));
}

TEST_F(MapRefinementTest, DataCountsOnTexture)
{
  refined(DISPARITY_PX, {});
  EXPECT_GT(cv::mean(refinement_.share())[0], 0.95);
}

}  // namespace
}  // namespace light_field_depth::multiview
