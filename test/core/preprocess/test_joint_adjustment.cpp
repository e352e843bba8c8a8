#include "core/preprocess/joint_adjustment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
constexpr double EXPECTED_PX = 0.5;

/// A cross of grey views of a plane with disparities of -1 to 1 pixel.
const testing::SyntheticLightField& scene()
{
  static const testing::SyntheticLightField rendered = []
  {
    testing::SceneSettings settings;
    settings.size = {128, 96};
    settings.positions = testing::crossPositions(5, 5);
    settings.samples = 2;
    settings.grey = true;
    return testing::renderScene({testing::plane(-1.0, 2.0 / 128.0, 0.0, testing::noiseTexture(4, 24.0))},
                                settings);
  }();
  return rendered;
}

/// Points on a lattice, with disparities that are off by up to a fifth of a pixel.
Adjustment startingPoint(const LightField& light_field)
{
  Adjustment adjustment;
  adjustment.views.resize(light_field.views.size());
  for (int y = 12; y < 84; y += 6)
  {
    for (int x = 12; x < 116; x += 6)
    {
      const float wrong = 0.2F * std::sin(static_cast<float>(5 * x + 3 * y));
      adjustment.points.push_back({{x, y}, scene().truth.at<float>(y, x) + wrong});
    }
  }
  return adjustment;
}

double rootMeanSquareError(const Adjustment& adjustment)
{
  double squares = 0.0;
  for (const AdjustedPoint& point : adjustment.points)
  {
    const double error = point.disparity - scene().truth.at<float>(point.pixel);
    squares += error * error;
  }
  return std::sqrt(squares / static_cast<double>(adjustment.points.size()));
}

TEST(JointAdjustment, FindsTheDisparitiesWhereNothingIsOff)
{
  Adjustment adjustment = startingPoint(scene().light_field);
  EXPECT_GT(rootMeanSquareError(adjustment), 0.12);
  ThreadPool pool(2);
  adjustJointly(SlopedViews(scene().light_field, pool), EXPECTED_PX, 4, pool, adjustment);
  // Samples between pixels are smoother than those at pixels, which moves the minimum by some hundredths.
  EXPECT_LT(rootMeanSquareError(adjustment), 0.05);
  EXPECT_NEAR(adjustment.step_ratio, 1.0, 0.01);
  for (const ViewMisfit& misfit : adjustment.views)
  {
    EXPECT_LT(cv::norm(misfit.shift_px), 0.03);
  }
}

TEST(JointAdjustment, FindsAViewThatIsShiftedAcrossItsSteps)
{
  LightField wrong = scene().light_field;
  const std::size_t shifted = wrong.views.size() - 1;  // below the reference
  ASSERT_EQ(wrong.views[shifted].steps, cv::Point2d(0, 2));
  wrong.views[shifted].offset_px.x -= 0.3;
  Adjustment adjustment = startingPoint(wrong);
  ThreadPool pool(2);
  adjustJointly(SlopedViews(wrong, pool), EXPECTED_PX, 5, pool, adjustment);
  EXPECT_NEAR(adjustment.views[shifted].shift_px.x, 0.3, 0.03);
  EXPECT_NEAR(adjustment.views[shifted].shift_px.y, 0.0, 0.05);
  EXPECT_EQ(adjustment.views[wrong.reference_index].shift_px, cv::Point2d());
}

TEST(JointAdjustment, FindsUnequalStepsOfRowsAndColumns)
{
  LightField wrong = scene().light_field;
  for (View& view : wrong.views)
  {
    view.steps.y /= 1.1;
  }
  Adjustment adjustment = startingPoint(wrong);
  ThreadPool pool(2);
  adjustJointly(SlopedViews(wrong, pool), EXPECTED_PX, 6, pool, adjustment);
  EXPECT_NEAR(adjustment.step_ratio, 1.1, 0.02);
}

TEST(JointAdjustment, PointsTellWhichOfTwoAdjustmentsIsRight)
{
  LightField wrong = scene().light_field;
  const std::size_t shifted = wrong.views.size() - 1;
  wrong.views[shifted].offset_px.x -= 0.5;
  const Adjustment unaware = startingPoint(wrong);
  Adjustment right = unaware;
  right.views[shifted].shift_px.x = 0.5;
  Adjustment worse = unaware;
  worse.views[shifted].shift_px.x = -0.5;
  ThreadPool pool(2);
  const auto corrected = compareFits(SlopedViews(wrong, pool), {unaware, right}, pool);
  EXPECT_LT(corrected[1], 0.8 * corrected[0]);
  const auto made_worse = compareFits(SlopedViews(wrong, pool), {unaware, worse}, pool);
  EXPECT_GT(made_worse[1], 1.1 * made_worse[0]);
  ThreadPool one(1);
  EXPECT_EQ(compareFits(SlopedViews(wrong, one), {unaware, right}, one), corrected);
}

TEST(JointAdjustment, WithoutPointsNothingHappens)
{
  Adjustment adjustment;
  adjustment.views.resize(scene().light_field.views.size());
  ThreadPool pool(1);
  adjustJointly(SlopedViews(scene().light_field, pool), EXPECTED_PX, 3, pool, adjustment);
  EXPECT_EQ(adjustment.step_ratio, 1.0);
}

TEST(JointAdjustment, DoesNotDependOnTheNumberOfThreads)
{
  Adjustment one = startingPoint(scene().light_field);
  Adjustment three = one;
  ThreadPool single(1);
  ThreadPool several(3);
  adjustJointly(SlopedViews(scene().light_field, single), EXPECTED_PX, 1, single, one);
  adjustJointly(SlopedViews(scene().light_field, several), EXPECTED_PX, 1, several, three);
  EXPECT_EQ(one.points[7].disparity, three.points[7].disparity);
  EXPECT_EQ(one.step_ratio, three.step_ratio);
}

}  // namespace
}  // namespace light_field_depth
