#include "core/multiview/scene_measurement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/synthetic_scene.h"

namespace light_field_depth::multiview
{
namespace
{
testing::SceneSettings crossSettings()
{
  testing::SceneSettings settings;
  settings.size = {160, 120};
  settings.positions = testing::crossPositions(5, 5);
  settings.samples = 2;
  return settings;
}

LightField rendered(const testing::SceneSettings& settings)
{
  return testing::renderScene(testing::standardScene(settings.size), settings).light_field;
}

struct Measured
{
  LightField views;
  SceneMeasures measures;
  std::vector<std::string> stages;
};

Measured measured(const LightField& light_field, const MultiviewOptions& options = {},
                  const EstimateRequest& request = {})
{
  ThreadPool pool(2);
  RunContext context(pool);
  SceneMeasurement measurement;
  Measured result;
  result.views = measurement.measure(light_field, request, options, context, result.measures);
  for (const StageTime& time : context.stage_times)
  {
    result.stages.push_back(time.stage);
  }
  return result;
}

TEST(SceneMeasurement, NoiseOfOneImageCountsUnlessViewsDifferByMuchMore)
{
  ThreadPool pool(2);
  testing::SceneSettings settings = crossSettings();
  EXPECT_LT(measureNoise(rendered(settings), {-1.3F, 2.1F}, pool), 1.2F) << "clean";
  settings.noise_sigma = 4.0;
  EXPECT_NEAR(measureNoise(rendered(settings), {-1.3F, 2.1F}, pool), 4.0F, 0.6F);
}

TEST(SceneMeasurement, FindsRangeAndNoiseAndSharesEvenViews)
{
  testing::SceneSettings settings = crossSettings();
  settings.noise_sigma = 3.0;
  const LightField field = rendered(settings);
  const Measured found = measured(field);
  EXPECT_EQ(found.stages, (std::vector<std::string>{"exposure", "range", "registration", "noise"}));
  EXPECT_NEAR(found.measures.range.min, -1.2F, 0.4F);
  EXPECT_NEAR(found.measures.range.max, 2.0F, 0.4F);
  EXPECT_NEAR(found.measures.noise_sigma, 3.0F, 0.5F);
  ASSERT_EQ(found.measures.exposures.size(), field.views.size());
  EXPECT_TRUE(std::none_of(found.measures.exposures.begin(), found.measures.exposures.end(),
                           [](const ViewExposure& exposure) { return exposure.differs; }));
  EXPECT_EQ(found.views.views[0].image.data, field.views[0].image.data);
}

TEST(SceneMeasurement, ViewsBecomeEquallyBright)
{
  testing::SceneSettings settings = crossSettings();
  settings.degrade = [](const GridPosition& grid, cv::Mat& values) {
    values *= grid == GridPosition{2, 4} ? 0.8 : 1.0;
  };
  const Measured found = measured(rendered(settings));
  const auto dark = std::find_if(found.views.views.begin(), found.views.views.end(),
                                 [](const View& view) {
                                   return view.grid == GridPosition{2, 4};
                                 });
  const auto index = static_cast<std::size_t>(dark - found.views.views.begin());
  EXPECT_TRUE(found.measures.exposures[index].differs);
  EXPECT_NEAR(found.measures.exposures[index].gain[0], 1.25, 0.03);
  EXPECT_NEAR(cv::mean(dark->image)[1], cv::mean(found.views.reference().image)[1], 3.0);
}

TEST(SceneMeasurement, ARangeThatIsGivenIsTaken)
{
  EstimateRequest request;
  request.disparity_range = DisparityRange{-5.0F, 5.0F};
  const Measured found = measured(rendered(crossSettings()), {}, request);
  EXPECT_EQ(found.measures.range.min, -5.0F);
  EXPECT_EQ(found.measures.range.max, 5.0F);
}

TEST(SceneMeasurement, RegistrationIsMeasuredUnlessItIsSwitchedOff)
{
  LightField shifted = rendered(crossSettings());
  for (View& view : shifted.views)
  {
    view.steps.y /= 1.08;
  }
  MultiviewOptions options;
  const Measured found = measured(shifted, options);
  EXPECT_EQ(found.stages, (std::vector<std::string>{"exposure", "range", "registration", "noise"}));
  EXPECT_TRUE(found.measures.registration.differs);
  EXPECT_NEAR(found.measures.registration.step_ratio, 1.08, 0.02);
}

TEST(SceneMeasurement, ManyViewsOfThePresetFastAreMeasuredAtHalfTheirSize)
{
  testing::SceneSettings settings = crossSettings();
  settings.size = {256, 192};
  settings.positions = testing::crossPositions(7, 7);
  MultiviewOptions options;
  options.preset = MultiviewPreset::Fast;
  const Measured found = measured(rendered(settings), options);
  EXPECT_NEAR(found.measures.range.min, -1.2F, 0.5F);
  EXPECT_NEAR(found.measures.range.max, 2.0F, 0.5F);
  EXPECT_EQ(found.measures.exposures.size(), 13U);
}

}  // namespace
}  // namespace light_field_depth::multiview
