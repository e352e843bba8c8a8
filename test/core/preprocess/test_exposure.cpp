#include "light_field_depth/core/exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/evaluation/evaluation.h"
#include "support/benchmark_scenes.h"
#include "support/named_scenes.h"

namespace light_field_depth
{
namespace
{
using testing::NamedScene;
using testing::SceneSettings;
using testing::SyntheticLightField;

SyntheticLightField standardScene(std::vector<GridPosition> positions,
                                  std::function<void(const GridPosition&, cv::Mat&)> degrade = {})
{
  SceneSettings settings;
  settings.size = cv::Size(192, 144);
  settings.positions = std::move(positions);
  settings.samples = 2;
  settings.degrade = std::move(degrade);
  return testing::renderScene(testing::standardScene(settings.size), settings);
}

double meanAbsoluteDifference(const cv::Mat& a, const cv::Mat& b)
{
  return cv::norm(a, b, cv::NORM_L1) /
         static_cast<double>(a.total() * static_cast<std::size_t>(a.channels()));
}

/// The largest of the views' mean absolute differences in grey levels.
double largestDifference(const LightField& a, const LightField& b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.views.size(); ++i)
  {
    largest = std::max(largest, meanAbsoluteDifference(a.views[i].image, b.views[i].image));
  }
  return largest;
}

LightField withoutDifferences(const LightField& light_field)
{
  ThreadPool pool(2);
  return compensateExposure(light_field, estimateExposure(light_field, pool), pool);
}

TEST(Exposure, FindsGainOffsetAndWhiteBalance)
{
  const cv::Scalar gain(0.9, 1.05, 1.2);
  const cv::Scalar offset(5.0, -4.0, 2.0);
  const auto scene = standardScene(testing::crossPositions(5, 5),
                                   [&](const GridPosition& grid, cv::Mat& values)
                                   {
                                     if (grid == GridPosition{2, 4})
                                     {
                                       cv::multiply(values, gain, values);
                                       values += offset;
                                     }
                                   });
  ThreadPool pool(2);
  const std::vector<ViewExposure> exposures = estimateExposure(scene.light_field, pool);
  for (std::size_t i = 0; i < exposures.size(); ++i)
  {
    const bool changed = scene.light_field.views[i].grid == GridPosition{2, 4};
    EXPECT_EQ(exposures[i].differs, changed) << toString(scene.light_field.views[i].grid);
    for (int channel = 0; changed && channel < 3; ++channel)
    {
      EXPECT_NEAR(exposures[i].gain[channel], 1.0 / gain[channel], 0.01);
      EXPECT_NEAR(exposures[i].offset[channel], -offset[channel] / gain[channel], 1.0);
    }
    EXPECT_LT(cv::norm(exposures[i].shading), 0.02);
  }
}

TEST(Exposure, RecoversAnotherToneCurveOfAPair)
{
  constexpr double GAMMA = 1.35;
  constexpr double WHITE = 255.0;
  const auto degrade = [](const GridPosition& grid, cv::Mat& values)
  {
    if (grid == GridPosition{0, 1})
    {
      cv::pow(cv::max(values, 0.0) / WHITE, GAMMA, values);
      values = values * (0.95 * WHITE) + cv::Scalar::all(4.0);
    }
  };
  const LightField degraded = standardScene(testing::gridPositions(1, 2), degrade).light_field;
  const LightField expected = standardScene(testing::gridPositions(1, 2)).light_field;
  ThreadPool pool(2);
  const std::vector<ViewExposure> exposures = estimateExposure(degraded, pool);
  EXPECT_TRUE(exposures[1].differs);
  EXPECT_LT(exposures[1].bend[1], -0.02);
  const LightField compensated = compensateExposure(degraded, exposures, pool);
  EXPECT_GT(largestDifference(degraded, expected), 10.0);
  EXPECT_LT(largestDifference(compensated, expected), 2.0);
}

TEST(Exposure, OfMoreViewsStaysALine)
{
  for (const NamedScene& scene : {testing::exposureDifferences(), testing::vignetting()})
  {
    ThreadPool pool(2);
    for (const ViewExposure& exposure : estimateExposure(scene.render().light_field, pool))
    {
      EXPECT_EQ(exposure.bend, cv::Vec3d()) << scene.name;
    }
  }
}

TEST(Exposure, UndoesWhatTheNamedScenesDoToTheirViews)
{
  for (NamedScene scene : {testing::exposureDifferences(), testing::vignetting()})
  {
    const LightField degraded = scene.render().light_field;
    scene.settings.degrade = {};
    LightField expected = scene.render().light_field;
    const LightField compensated = withoutDifferences(degraded);
    // The reference keeps its own vignetting, which is then everybody's.
    const cv::Mat reference = expected.reference().image;
    cv::Mat ratio;
    cv::divide(degraded.reference().image, reference, ratio, 1.0, CV_32F);
    for (View& view : expected.views)
    {
      cv::multiply(view.image, ratio, view.image, 1.0, CV_8U);
    }
    EXPECT_GT(largestDifference(degraded, expected), 4.0) << scene.name;
    EXPECT_LT(largestDifference(compensated, expected), 1.5) << scene.name;
  }
}

TEST(Exposure, LeavesViewsWithoutDifferenceAsTheyAre)
{
  for (const NamedScene& scene : testing::namedScenes())
  {
    if (scene.name == "exposure_differences" || scene.name == "vignetting" ||
        scene.name == "view_dependent_brightness")
    {
      continue;
    }
    const LightField light_field = scene.render().light_field;
    const LightField compensated = withoutDifferences(light_field);
    for (std::size_t i = 0; i < light_field.views.size(); ++i)
    {
      EXPECT_EQ(compensated.views[i].image.data, light_field.views[i].image.data)
          << scene.name << ", view " << i;
    }
  }
}

TEST(Exposure, LeavesOutWhatIsCutOff)
{
  // Much of the scene is brighter than white in the view with the larger gain.
  constexpr double GAIN = 1.25;
  const auto overexpose = [=](const GridPosition& grid, cv::Mat& values) {
    values = (values + cv::Scalar::all(50.0)) * (grid == GridPosition{0, 1} ? GAIN : 1.0);
  };
  LightField light_field = standardScene(testing::gridPositions(1, 3), overexpose).light_field;
  light_field = makeLightField(light_field.views, GridPosition{0, 0});
  const cv::Mat bright = light_field.views[1].image.reshape(1);
  ASSERT_GT(cv::countNonZero(bright == 255), 0.1 * static_cast<double>(bright.total()));
  ThreadPool pool(2);
  const std::vector<ViewExposure> exposures = estimateExposure(light_field, pool);
  EXPECT_FALSE(exposures[0].differs);
  EXPECT_TRUE(exposures[1].differs);
  EXPECT_FALSE(exposures[2].differs);
  for (int channel = 0; channel < 3; ++channel)
  {
    EXPECT_NEAR(exposures[1].gain[channel], 1.0 / GAIN, 0.04);
  }
}

TEST(Exposure, TakesGreyViewsAndTheSmallest)
{
  SceneSettings settings;
  settings.grey = true;
  settings.positions = testing::gridPositions(3, 3);
  settings.degrade = [](const GridPosition& grid, cv::Mat& values) { values *= grid.row == 0 ? 0.85 : 1.0; };
  for (const cv::Size size : {cv::Size(160, 120), cv::Size(16, 16)})
  {
    settings.size = size;
    const auto scene = testing::renderScene(testing::standardScene(size), settings);
    ThreadPool pool(2);
    const std::vector<ViewExposure> exposures = estimateExposure(scene.light_field, pool);
    for (std::size_t i = 0; i < exposures.size(); ++i)
    {
      EXPECT_EQ(exposures[i].differs, size.width > 16 && scene.light_field.views[i].grid.row == 0);
      if (exposures[i].differs)
      {
        EXPECT_NEAR(exposures[i].gain[0], 1.0 / 0.85, 0.015);
      }
    }
    EXPECT_EQ(withoutDifferences(scene.light_field).reference().image.type(), CV_8UC1);
  }
}

TEST(Exposure, FindsNothingWhereNothingHasTexture)
{
  SceneSettings settings;
  settings.positions = testing::gridPositions(3, 3);
  settings.noise_sigma = 3.0;
  const auto scene = renderScene({testing::plane(0, 0, 0, testing::constantTexture({90, 90, 90}))}, settings);
  ThreadPool pool(2);
  for (const ViewExposure& exposure : estimateExposure(scene.light_field, pool))
  {
    EXPECT_FALSE(exposure.differs);
  }
}

TEST(Exposure, DoesNotDependOnTheNumberOfThreads)
{
  const LightField light_field = testing::exposureDifferences().render().light_field;
  ThreadPool one(1);
  ThreadPool three(3);
  const auto a = compensateExposure(light_field, estimateExposure(light_field, one), one);
  const auto b = compensateExposure(light_field, estimateExposure(light_field, three), three);
  for (std::size_t i = 0; i < a.views.size(); ++i)
  {
    EXPECT_EQ(cv::norm(a.views[i].image, b.views[i].image, cv::NORM_INF), 0.0);
  }
}

TEST(Exposure, RejectsSixteenBits)
{
  auto scene = standardScene(testing::gridPositions(1, 2));
  for (View& view : scene.light_field.views)
  {
    view.image.convertTo(view.image, CV_16U);
  }
  ThreadPool pool(1);
  EXPECT_THROW(estimateExposure(scene.light_field, pool), InputError);
}

/// Gain and offset of every view but the reference drawn at random.
LightField withRandomExposure(const LightField& light_field)
{
  LightField result = light_field;
  cv::RNG random(5);
  for (std::size_t i = 0; i < result.views.size(); ++i)
  {
    const double gain = random.uniform(0.8, 1.25);
    const double offset = random.uniform(-8.0, 8.0);
    if (i != result.reference_index)
    {
      cv::Mat image;
      result.views[i].image.convertTo(image, -1, gain, offset);
      result.views[i].image = image;
    }
  }
  return result;
}

TEST(Exposure, CostsTheNamedScenesHardlyAnyAccuracy)
{
  Pipeline pipeline(2);
  for (const NamedScene& scene : testing::namedScenes())
  {
    const SyntheticLightField input = scene.render();
    const LightField exposed = withRandomExposure(input.light_field);
    const cv::Mat without = pipeline.run(input.light_field, {}, {}).estimate.disparity;
    const cv::Mat with = pipeline.run(exposed, {}, {}).estimate.disparity;
    EXPECT_LT(testing::meanAbsoluteError(with, input.truth),
              1.1 * testing::meanAbsoluteError(without, input.truth) + 0.002)
        << scene.name;
  }
}

TEST(Exposure, CostsTheBenchmarkScenesHardlyAnyAccuracy)
{
  Pipeline pipeline(2);
  for (const std::string name : {"cotton", "antinous"})
  {
    const auto scene = testing::readBenchmarkScene(name);
    if (!scene)
    {
      GTEST_SKIP() << name << " is not in " << testing::BENCHMARK_SCENES;
    }
    const LightField clean = selectViews(scene->light_field, ViewSelection::Cross);
    ThreadPool pool(2);
    for (const ViewExposure& exposure : estimateExposure(clean, pool))
    {
      EXPECT_FALSE(exposure.differs) << name;
    }
    const Evaluation without = evaluate(pipeline.run(clean, {}, {}).estimate.disparity, scene->truth);
    const Evaluation with =
        evaluate(pipeline.run(withRandomExposure(clean), {}, {}).estimate.disparity, scene->truth);
    EXPECT_LT(with.mse_100, 1.2 * without.mse_100) << name;
    EXPECT_LT(with.badpix_007, 1.2 * without.badpix_007) << name;
  }
}

}  // namespace
}  // namespace light_field_depth
