// What must not change the map, or must change it in a known way: places and axes of the images, brightness,
// unit of disparity.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "light_field_depth/core/pipeline.h"
#include "support/instruction_sets.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
constexpr int BORDER_PX = 8;

testing::SyntheticLightField standardLightField()
{
  testing::SceneSettings settings;
  settings.size = {120, 96};
  settings.positions = testing::crossPositions(5, 5);
  settings.samples = 2;
  return testing::renderScene(testing::standardScene(settings.size), settings);
}

cv::Mat disparityOf(const LightField& light_field, const std::string& preset_name, int threads = 2)
{
  PipelineOptions options;
  for (const MultiviewPreset preset : {MultiviewPreset::Quality, MultiviewPreset::Balanced,
                                       MultiviewPreset::Realtime, MultiviewPreset::Fast})
  {
    if (toString(preset) == preset_name)
    {
      options.multiview.preset = preset;
    }
  }
  return Pipeline(threads).run(light_field, options, {}).estimate.disparity;
}

/// The light field with every view changed.
LightField changed(LightField light_field, const std::function<void(View&)>& change)
{
  for (View& view : light_field.views)
  {
    view.image = view.image.clone();
    change(view);
  }
  return light_field;
}

/// Two maps are equal up to so much in so many percent of the pixels, borders left out, and to 0.3 px in 99
/// %.
void expectEqual(const cv::Mat& a, const cv::Mat& b, double px, double percent)
{
  constexpr double FEW_MOVE_PX = 0.3;
  EXPECT_GE(100.0 - testing::badPercentage(a, b, px, BORDER_PX), percent);
  EXPECT_GE(100.0 - testing::badPercentage(a, b, FEW_MOVE_PX, BORDER_PX), 99.0);
}

bool isFast()
{
  return ::testing::UnitTest::GetInstance()->current_test_info()->value_param() == std::string("\"fast\"");
}

class Invariances : public ::testing::TestWithParam<const char*>
{
};

TEST_P(Invariances, AConstantOnAllViewsChangesNothing)
{
  const LightField light_field =
      changed(standardLightField().light_field, [](View& view) { view.image *= 0.8; });
  const LightField brighter = changed(light_field, [](View& view) { view.image += cv::Scalar::all(30); });
  const cv::Mat before = disparityOf(light_field, GetParam());
  // Noise grows with brightness (brightness_slope), which weighs against smoothness; fast measures it
  // coarsely.
  expectEqual(disparityOf(brighter, GetParam()), before, isFast() ? 0.05 : 1e-3, isFast() ? 98.0 : 100.0);
}

TEST_P(Invariances, TwiceTheStepsAreHalfTheDisparity)
{
  const LightField light_field = standardLightField().light_field;
  const LightField wider = changed(light_field, [](View& view) { view.steps *= 2.0; });
  const cv::Mat twice = 2.0 * disparityOf(wider, GetParam());
  expectEqual(twice, disparityOf(light_field, GetParam()), 1e-6, 100.0);
}

TEST_P(Invariances, AMirroredSceneHasTheMirroredMap)
{
  const LightField light_field = standardLightField().light_field;
  const cv::Mat before = disparityOf(light_field, GetParam());
  for (const bool upside_down : {false, true})
  {
    const LightField mirrored = changed(light_field,
                                        [upside_down](View& view)
                                        {
                                          cv::Mat image;
                                          cv::flip(view.image, image, upside_down ? 0 : 1);
                                          view.image = image;
                                          (upside_down ? view.steps.y : view.steps.x) *= -1.0;
                                        });
    cv::Mat after;
    cv::flip(disparityOf(mirrored, GetParam()), after, upside_down ? 0 : 1);
    SCOPED_TRACE(upside_down);
    expectEqual(after, before, 0.05, 91.0);
  }
}

TEST_P(Invariances, RowsForColumnsTransposeTheMap)
{
  const LightField light_field = standardLightField().light_field;
  const LightField transposed = changed(light_field,
                                        [](View& view)
                                        {
                                          view.image = view.image.t();
                                          std::swap(view.steps.x, view.steps.y);
                                          std::swap(view.grid.row, view.grid.column);
                                        });
  const cv::Mat after = disparityOf(transposed, GetParam()).t();
  expectEqual(after, disparityOf(light_field, GetParam()), 1e-3, 100.0);
}

TEST_P(Invariances, TheMapMovesWithTheImages)
{
  // The same scene with its borders in other places.
  testing::SceneSettings settings;
  settings.size = {152, 128};
  settings.positions = testing::crossPositions(5, 5);
  settings.samples = 2;
  const LightField whole = testing::renderScene(testing::standardScene(settings.size), settings).light_field;
  const auto cropped = [&](const cv::Point& from)
  {
    return disparityOf(changed(whole, [&](View& view)
                               { view.image = view.image(cv::Rect(from, cv::Size(128, 104))).clone(); }),
                       GetParam());
  };
  const cv::Mat before = cropped({8, 8});
  for (const cv::Point& move : {cv::Point(8, 0), cv::Point(0, 8), cv::Point(-8, 8)})
  {
    const cv::Mat after = cropped(cv::Point(8, 8) + move);
    const cv::Rect common(8, 8, 112, 88);
    SCOPED_TRACE(::testing::Message() << move);
    expectEqual(after(common - move), before(common), 0.05, 94.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, Invariances, ::testing::Values("quality", "balanced", "fast"));

TEST(Planes, OfEverySlopeAndDisparityAreFoundToAFiftiethOfAPixel)
{
  struct Slope
  {
    double x;
    double y;
  };
  for (const double disparity : {-3.3, -1.0, -0.37, 0.0, 0.11, 0.5, 1.25, 2.9})
  {
    for (const Slope& slope : {Slope{0.0, 0.0}, Slope{0.01, 0.0}, Slope{0.0, -0.02}, Slope{-0.015, 0.01}})
    {
      testing::SceneSettings settings;
      settings.size = {96, 80};
      settings.positions = testing::crossPositions(5, 5);
      settings.samples = 1;
      const auto scene = testing::renderScene(
          {testing::plane(disparity, slope.x, slope.y, testing::noiseTexture(7, 12.0))}, settings);
      const cv::Mat found = disparityOf(scene.light_field, "balanced");
      EXPECT_LT(testing::meanAbsoluteError(found, scene.truth), 0.02)
          << disparity << ", slope " << slope.x << ", " << slope.y;
    }
  }
}

TEST(ViewsOfNoise, AreNotTrusted)
{
  for (const int side : {3, 5})
  {
    std::vector<View> views;
    for (const GridPosition& position : testing::gridPositions(side, side))
    {
      cv::Mat noise(96, 128, CV_8UC3);
      cv::RNG(static_cast<std::uint64_t>(views.size() + 1)).fill(noise, cv::RNG::UNIFORM, 0, 256);
      views.push_back(gridView(position.row, position.column, noise));
    }
    const auto estimate = Pipeline(2).run(makeLightField(views), {}, {}).estimate;
    EXPECT_LT(cv::mean(estimate.confidence)[0], 0.05) << side;
  }
}

TEST(Threads, OfAnyNumberGiveTheSameBytes)
{
  const LightField light_field = standardLightField().light_field;
  for (const char* const preset : {"quality", "fast"})
  {
    const cv::Mat one = disparityOf(light_field, preset, 1);
    for (const int threads : {2, 3, 8, 16})
    {
      const cv::Mat many = disparityOf(light_field, preset, threads);
      EXPECT_EQ(cv::norm(one, many, cv::NORM_INF), 0.0) << preset << ", " << threads;
    }
  }
}

class InstructionSets : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(Every, InstructionSets, testing::everyInstructionSet(), testing::instructionSetName);

TEST_P(InstructionSets, GiveTheSameBytesInEveryRun)
{
  static std::map<std::string, cv::Mat> maps;  // of the first set
  const LightField light_field = standardLightField().light_field;
  for (const char* const preset : {"quality", "fast"})
  {
    const cv::Mat here = disparityOf(light_field, preset);
    const cv::Mat& first = maps.emplace(preset, here).first->second;
    EXPECT_EQ(cv::norm(first, here, cv::NORM_INF), 0.0) << preset;
    EXPECT_EQ(cv::norm(here, disparityOf(light_field, preset), cv::NORM_INF), 0.0) << preset << ", again";
  }
}

}  // namespace
}  // namespace light_field_depth
