#include "light_field_depth/core/registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "camera_model.h"
#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/evaluation/evaluation.h"
#include "support/named_scenes.h"

namespace light_field_depth
{
namespace
{
const DisparityRange RANGE = {-1.3F, 2.1F};

/// Large enough for the search at half the resolution.
const testing::SyntheticLightField& scene()
{
  static const testing::SyntheticLightField rendered = []
  {
    testing::SceneSettings settings;
    settings.size = cv::Size(256, 192);
    settings.positions = testing::crossPositions(7, 7);
    settings.samples = 2;
    return testing::renderScene(testing::standardScene(settings.size), settings);
  }();
  return rendered;
}

/// Numbers of a size, the same in every run.
cv::Point2d scatter(std::size_t i, double size)
{
  return size * cv::Point2d(std::sin(12.9898 * static_cast<double>(i + 1)) * std::sqrt(2.0),
                            std::cos(78.233 * static_cast<double>(i + 1)) * std::sqrt(2.0));
}

/// Says of each view that it stands where it does not.
LightField withWrongSteps(LightField light_field, double ratio, double offset_px)
{
  for (View& view : light_field.views)
  {
    view.steps.y /= ratio;
    view.offset_px.y += offset_px * view.steps.y;
  }
  return light_field;
}

/// Of the shifts, without their line between rows and columns, which estimateRegistration() tells apart.
std::vector<cv::Point2d> withoutLine(const LightField& light_field, std::vector<cv::Point2d> shifts)
{
  double row = 0.0;
  double column = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < shifts.size(); ++i)
  {
    row += shifts[i].x * light_field.views[i].steps.x;
    column += shifts[i].y * light_field.views[i].steps.y;
    squares += light_field.views[i].steps.x * light_field.views[i].steps.x;
  }
  for (std::size_t i = 0; i < shifts.size(); ++i)
  {
    const cv::Point2d steps = light_field.views[i].steps;
    shifts[i] -= cv::Point2d(steps.x * row / squares, steps.y * column / squares);
  }
  return shifts;
}

TEST(Registration, LeavesCleanScenesExactlyAlone)
{
  ThreadPool pool(2);
  EXPECT_FALSE(estimateRegistration(scene().light_field, RANGE, pool).differs);
  for (const testing::NamedScene& named : {testing::slantedPlanes(), testing::noise(), testing::clutter()})
  {
    const testing::SyntheticLightField rendered = named.render();
    double min = 0.0;
    double max = 0.0;
    cv::minMaxIdx(rendered.truth, &min, &max);
    const Registration found =
        estimateRegistration(rendered.light_field, {static_cast<float>(min), static_cast<float>(max)}, pool);
    EXPECT_FALSE(found.differs) << named.name;
    const LightField corrected = correctRegistration(rendered.light_field, found, pool);
    for (std::size_t i = 0; i < corrected.views.size(); ++i)
    {
      EXPECT_EQ(corrected.views[i].steps, rendered.light_field.views[i].steps);
      EXPECT_EQ(corrected.views[i].offset_px, rendered.light_field.views[i].offset_px);
      EXPECT_EQ(corrected.views[i].image.data, rendered.light_field.views[i].image.data);
    }
  }
}

/// What noise looks like does not hold for other points.
TEST(Registration, LeavesNoisyScenesAlone)
{
  ThreadPool pool(2);
  cv::RNG random(3);
  for (const double sigma : {3.0, 6.0, 10.0})
  {
    LightField noisy = scene().light_field;
    for (View& view : noisy.views)
    {
      cv::Mat noise(view.image.size(), CV_16SC3);
      random.fill(noise, cv::RNG::NORMAL, 0.0, sigma);
      cv::Mat image;
      cv::add(view.image, noise, image, {}, CV_8U);
      view.image = image;
    }
    EXPECT_FALSE(estimateRegistration(noisy, RANGE, pool).differs) << sigma;
  }
}

TEST(Registration, AnEstimateTellsWhatItPutRight)
{
  const LightField wrong = withWrongSteps(scene().light_field, 0.93, 0.1);
  PipelineOptions options;
  options.disparity_range = RANGE;
  options.multiview.registration = true;
  const DisparityEstimate estimate = Pipeline(2).run(wrong, options, {}).estimate;
  EXPECT_NEAR(estimate.registration.step_ratio, 0.93, 0.01);
  LightField shifted = scene().light_field;
  for (std::size_t i = 0; i < shifted.views.size(); ++i)
  {
    shifted.views[i].offset_px += i == shifted.reference_index ? cv::Point2d() : scatter(i, 0.2);
  }
  View unused = shifted.views.front();
  unused.grid = {6, 6};
  unused.steps = {3.0, 3.0};
  shifted.views.push_back(unused);
  const Registration found = Pipeline(2).run(shifted, options, {}).estimate.registration;
  ASSERT_EQ(found.views.size(), shifted.views.size());
  EXPECT_EQ(found.views.back().shift_px, cv::Point2d()) << "not in the row or column of the reference";
  ThreadPool pool(2);
  EXPECT_EQ(registeredViews(shifted, found, pool).views.size(), shifted.views.size() - 1);
  EXPECT_EQ(registeredViews(shifted, {}, pool).views.size(), shifted.views.size());
}

TEST(Registration, FindsUnequalStepsOfRowsAndColumns)
{
  ThreadPool pool(2);
  for (const auto& [ratio, offset_px] : {std::pair{0.95, 0.0}, std::pair{1.04, 0.1}, std::pair{1.0, -0.15}})
  {
    const LightField wrong = withWrongSteps(scene().light_field, ratio, offset_px);
    const Registration found = estimateRegistration(wrong, RANGE, pool);
    EXPECT_TRUE(found.differs);
    EXPECT_NEAR(found.step_ratio, ratio, 0.01);
    EXPECT_NEAR(found.step_offset_px, offset_px, 0.015);
    // Rows and columns both move, so that all views together move least, at the middle of the range.
    const LightField corrected = correctRegistration(wrong, found, pool);
    double along = 0.0;
    double squares = 0.0;
    for (const View& view : corrected.views)
    {
      const double true_y = view.grid.row - 3.0;
      EXPECT_NEAR(view.steps.y, true_y, 0.03);
      const double middle = 0.5 * (RANGE.min + RANGE.max);
      const View& believed = wrong.views[static_cast<std::size_t>(&view - corrected.views.data())];
      const cv::Point2d moved =
          (view.offset_px - middle * view.steps) - (believed.offset_px - middle * believed.steps);
      along += moved.dot(believed.steps);
      squares += moved.dot(moved);
    }
    EXPECT_NEAR(along, 0.0, 0.05 * std::sqrt(squares) + 0.03);
  }
}

TEST(Registration, FindsTheShiftOfEachView)
{
  LightField wrong = scene().light_field;
  std::vector<cv::Point2d> shifts(wrong.views.size());
  for (std::size_t i = 0; i < wrong.views.size(); ++i)
  {
    if (i != wrong.reference_index)
    {
      shifts[i] = scatter(i, 0.2);
      wrong.views[i].offset_px -= shifts[i];
    }
  }
  ThreadPool pool(2);
  const Registration found = estimateRegistration(wrong, RANGE, pool);
  ASSERT_TRUE(found.differs);
  ASSERT_EQ(found.views.size(), wrong.views.size());
  EXPECT_FALSE(found.resample);
  const std::vector<cv::Point2d> expected = withoutLine(wrong, shifts);
  double squares = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const cv::Point2d error = found.views[i].shift_px - expected[i];
    squares += 0.5 * error.dot(error);
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(expected.size() - 1)), 0.04);
}

/// Two views stand in the row of a 3 x 3 array: their shifts alone must not decide the disparity of all.
TEST(Registration, ShiftsOfFewViewsDoNotMoveAllDisparities)
{
  testing::SceneSettings settings;
  settings.size = cv::Size(256, 192);
  settings.positions = testing::gridPositions(3, 3);
  LightField wrong = testing::renderScene(testing::standardScene(settings.size), settings).light_field;
  const LightField right = wrong;
  for (View& view : wrong.views)
  {
    // Along the steps in the row, where it looks like a disparity, and against them in the others.
    const double sign = view.steps.y == 0.0 ? 1.0 : -0.5;
    view.offset_px += 0.3 * sign * cv::Point2d(view.steps.x, 0.0);
  }
  ThreadPool pool(2);
  const Registration found = estimateRegistration(wrong, {RANGE.min - 0.3F, RANGE.max + 0.3F}, pool);
  ASSERT_TRUE(found.differs);
  const LightField corrected = correctRegistration(wrong, found, pool);
  for (std::size_t i = 0; i < corrected.views.size(); ++i)
  {
    EXPECT_LT(cv::norm(corrected.views[i].offset_px - right.views[i].offset_px), 0.06) << i;
  }
}

/// Along stripes and bars views may stand anywhere, and stripes match a period too far.
TEST(Registration, LeavesStripesAlone)
{
  ThreadPool pool(2);
  for (const testing::NamedScene& named : {testing::fineStripes(), testing::thinStructures()})
  {
    const testing::SyntheticLightField rendered = named.render();
    double min = 0.0;
    double max = 0.0;
    cv::minMaxIdx(rendered.truth, &min, &max);
    const LightField seen = benchmark::photograph(rendered.light_field);
    EXPECT_FALSE(estimateRegistration(seen, {static_cast<float>(min), static_cast<float>(max)}, pool).differs)
        << named.name;
  }
}

TEST(Registration, FindsAndTakesBackRollAndZoom)
{
  LightField wrong = scene().light_field;
  const double roll = 0.3 * CV_PI / 180.0;
  const double zoom = 0.004;
  for (std::size_t i = 0; i < wrong.views.size(); ++i)
  {
    if (i != wrong.reference_index)
    {
      const double sign = i % 3 == 0 ? -1.0 : 1.0;
      cv::Mat& image = wrong.views[i].image;
      const cv::Point2f middle(0.5F * static_cast<float>(image.cols - 1),
                               0.5F * static_cast<float>(image.rows - 1));
      // OpenCV's angle counts the other way round, since y points downwards.
      const cv::Mat matrix = cv::getRotationMatrix2D(middle, -sign * roll * 180.0 / CV_PI, 1.0 + zoom);
      cv::Mat moved;
      cv::warpAffine(image, moved, matrix, image.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
      image = moved;
    }
  }
  ThreadPool pool(2);
  const Registration found = estimateRegistration(wrong, RANGE, pool);
  ASSERT_TRUE(found.resample);
  for (std::size_t i = 0; i < wrong.views.size(); ++i)
  {
    if (i != wrong.reference_index)
    {
      EXPECT_NEAR(found.views[i].roll, (i % 3 == 0 ? -1.0 : 1.0) * roll, 0.15 * roll);
      EXPECT_NEAR(found.views[i].zoom, zoom, 0.25 * zoom);
    }
  }
  PipelineOptions options;
  options.disparity_range = RANGE;
  options.multiview.registration = true;
  const cv::Mat disparity = Pipeline(2).run(wrong, options, {}).estimate.disparity;
  const Evaluation corrected = evaluate(disparity, scene().truth);
  options.multiview.registration = false;
  const DisparityEstimate believed = Pipeline(2).run(wrong, options, {}).estimate;
  EXPECT_LT(corrected.badpix_007, 0.6 * evaluate(believed.disparity, scene().truth).badpix_007);
  const std::vector<std::string> sentences = describe(found, wrong);
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_NE(sentences.front().find("roll and zoom"), std::string::npos) << sentences.front();
}

TEST(Registration, DescribesWhatIsOffInSentencesWithNumbers)
{
  Registration registration;
  EXPECT_TRUE(describe(registration, scene().light_field).empty());
  registration.step_ratio = 1.024;
  registration.step_offset_px = -0.021;
  const std::vector<std::string> sentences = describe(registration, scene().light_field);
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_EQ(
      sentences.front(),
      "Disparities in the columns are 1.024 times those in the rows minus 0.021 px; check the baselines and "
      "the principal points.");
}

TEST(Registration, DoesNotDependOnTheNumberOfThreads)
{
  const LightField wrong = withWrongSteps(scene().light_field, 0.95, 0.1);
  ThreadPool one(1);
  ThreadPool three(3);
  EXPECT_EQ(estimateRegistration(wrong, RANGE, one).step_ratio,
            estimateRegistration(wrong, RANGE, three).step_ratio);
}

}  // namespace
}  // namespace light_field_depth
