#include "evaluation/view_samples.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
const testing::SyntheticLightField& scene()
{
  static const testing::SyntheticLightField rendered = []
  {
    testing::SceneSettings settings;
    settings.size = {160, 120};
    settings.positions = testing::gridPositions(3, 3);
    settings.samples = 3;
    return testing::renderScene(
        {testing::plane(0.8, 0.0, 0.0, testing::noiseTexture(6, 16.0)),
         testing::rectangle(0.8001, {0.0, 0.0, 40.0, 120.0}, testing::constantTexture({90, 90, 90}))},
        settings);
  }();
  return rendered;
}

TEST(ViewSamples, TheRightMapIsWhatAllViewsAgreeWith)
{
  ThreadPool pool(2);
  const ViewSamples samples = sampleViews(scene().light_field, scene().truth, pool);
  EXPECT_GT(samples.pixels, 1500);
  EXPECT_LE(samples.pixels, 5000);
  EXPECT_LT(samples.textured, samples.pixels * 8 / 10) << "the flat quarter has no contrast";
  EXPECT_GT(samples.agreeing, samples.textured * 95 / 100);
  EXPECT_LT(samples.difference_levels, 2.0);
  ASSERT_EQ(samples.views.size(), 8U);
  for (const ViewAgreement& view : samples.views)
  {
    EXPECT_NE(view.view_index, scene().light_field.reference_index);
    EXPECT_GT(view.share(), 0.9);
    EXPECT_LT(cv::norm(view.shift_px), 0.05);
  }
  ASSERT_EQ(samples.disparities.size(), static_cast<std::size_t>(samples.textured));
  EXPECT_NEAR(samples.disparities.front(), 0.8F, 1e-3F);
}

TEST(ViewSamples, AViewOfAnotherExposureAgreesAsWell)
{
  LightField uneven = scene().light_field;
  for (const auto& [index, gain] : {std::make_pair(std::size_t{0}, 0.5), std::make_pair(std::size_t{8}, 1.5)})
  {
    cv::Mat changed;  // the scene's own image stays as it is
    uneven.views[index].image.convertTo(changed, -1, gain);
    uneven.views[index].image = changed;
  }
  ThreadPool pool(2);
  for (const ViewAgreement& view : sampleViews(uneven, scene().truth, pool).views)
  {
    EXPECT_GT(view.share(), 0.9) << view.view_index;
    EXPECT_LT(cv::norm(view.shift_px), 0.08) << view.view_index;
  }
}

TEST(ViewSamples, AWrongMapIsNot)
{
  ThreadPool pool(2);
  const ViewSamples samples = sampleViews(scene().light_field, scene().truth + 6.0F, pool);
  EXPECT_LT(samples.agreeing, samples.textured / 4);
}

TEST(ViewSamples, TheShiftOfAViewIsMeasured)
{
  LightField shifted = scene().light_field;
  shifted.views[0].offset_px -= cv::Point2d(0.2, -0.12);
  ThreadPool pool(2);
  const ViewSamples samples = sampleViews(shifted, scene().truth, pool);
  for (const ViewAgreement& view : samples.views)
  {
    const cv::Point2d expected = view.view_index == 0 ? cv::Point2d(0.2, -0.12) : cv::Point2d();
    EXPECT_NEAR(view.shift_px.x, expected.x, 0.06);
    EXPECT_NEAR(view.shift_px.y, expected.y, 0.06);
  }
}

TEST(ViewSamples, PixelsWithoutDisparityAreNotAsked)
{
  cv::Mat map = scene().truth.clone();
  map.rowRange(0, 60).setTo(std::numeric_limits<float>::quiet_NaN());
  ThreadPool pool(1);
  const ViewSamples whole = sampleViews(scene().light_field, scene().truth, pool);
  const ViewSamples half = sampleViews(scene().light_field, map, pool);
  EXPECT_EQ(half.pixels, whole.pixels);
  EXPECT_NEAR(half.textured, 0.5 * whole.textured, 0.06 * whole.textured);
}

}  // namespace
}  // namespace light_field_depth
