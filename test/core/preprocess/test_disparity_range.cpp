#include "light_field_depth/core/disparity_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "support/benchmark_scenes.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
using testing::crossPositions;
using testing::gridPositions;
using testing::noiseTexture;
using testing::plane;
using testing::rectangle;
using testing::renderScene;
using testing::SceneSettings;
using testing::Surface;
using testing::SyntheticLightField;

/// A background, a slanted box and a small object right in front, spread over a range of disparities.
std::vector<Surface> layers(const cv::Size& size, double min, double max)
{
  const double w = size.width;
  const double h = size.height;
  const double width = max - min;
  return {
      plane(min, 0.2 * width / w, 0.0, noiseTexture(1, 16.0, {110, 130, 140})),
      rectangle(min + 0.6 * width, {0.2 * w, 0.25 * h, 0.3 * w, 0.5 * h},
                noiseTexture(2, 12.0, {150, 110, 90})),
      rectangle(max, {0.65 * w, 0.4 * h, 0.12 * w, 0.12 * w}, noiseTexture(3, 10.0, {90, 120, 160})),
  };
}

SyntheticLightField render(double min, double max, std::vector<GridPosition> positions, cv::Size size,
                           double noise_sigma = 0.0)
{
  SceneSettings settings;
  settings.size = size;
  settings.positions = std::move(positions);
  settings.samples = 2;
  settings.noise_sigma = noise_sigma;
  return renderScene(layers(size, min, max), settings);
}

double coveredPercentage(const DisparityRange& range, const cv::Mat& truth)
{
  int covered = 0;
  for (int y = 0; y < truth.rows; ++y)
  {
    for (int x = 0; x < truth.cols; ++x)
    {
      const float d = truth.at<float>(y, x);
      covered += d >= range.min && d <= range.max ? 1 : 0;
    }
  }
  return 100.0 * covered / static_cast<double>(truth.total());
}

/// Nearly all of the truth is inside, and the range is wider than the truth by at most `excess_px`.
void expectTight(const DisparityRange& range, const cv::Mat& truth, double excess_px)
{
  double min = 0.0;
  double max = 0.0;
  cv::minMaxIdx(truth, &min, &max);
  EXPECT_GE(coveredPercentage(range, truth), 99.8) << range.min << " .. " << range.max;
  EXPECT_GE(range.min, min - excess_px) << "the truth begins at " << min;
  EXPECT_LE(range.max, max + excess_px) << "the truth ends at " << max;
}

TEST(DisparityRange, FindsAFractionOfAPixelInADenseField)
{
  const auto scene = render(-0.02, 0.03, crossPositions(9, 9), {256, 192});
  ThreadPool pool(2);
  expectTight(findDisparityRange(scene.light_field, pool), scene.truth, 0.5);
}

TEST(DisparityRange, FindsAFewPixelsInADenseField)
{
  const auto scene = render(-1.5, 2.0, crossPositions(9, 9), {256, 192});
  ThreadPool pool(2);
  expectTight(findDisparityRange(scene.light_field, pool), scene.truth, 0.6);
}

TEST(DisparityRange, FindsTenPixelsBetweenSparseViews)
{
  const auto scene = render(2.0, 10.0, gridPositions(3, 3), {256, 192});
  ThreadPool pool(2);
  expectTight(findDisparityRange(scene.light_field, pool), scene.truth, 2.0);
}

TEST(DisparityRange, FindsFortyPixelsBetweenSparseViews)
{
  const auto scene = render(12.0, 40.0, gridPositions(3, 3), {384, 288});
  ThreadPool pool(2);
  expectTight(findDisparityRange(scene.light_field, pool), scene.truth, 3.0);
}

TEST(DisparityRange, HoldsForAPairARowAndAColumn)
{
  ThreadPool pool(2);
  for (const auto& positions : {gridPositions(1, 2), gridPositions(1, 5), gridPositions(5, 1)})
  {
    const auto scene = render(-2.0, 5.0, positions, {256, 192});
    SCOPED_TRACE(std::to_string(positions.size()) + " views");
    expectTight(findDisparityRange(scene.light_field, pool), scene.truth, 2.0);
  }
}

TEST(DisparityRange, OfAPairReachesFarBeyondThatOfArrays)
{
  const auto scene = render(60.0, 105.0, gridPositions(1, 2), {512, 160});
  const LightField pair = makeLightField(scene.light_field.views, GridPosition{0, 0});
  const cv::Mat truth = scene.light_field.reference_index == 0 ? scene.truth : cv::Mat();
  ASSERT_FALSE(truth.empty());
  ThreadPool pool(2);
  const DisparityRange range = findDisparityRange(pair, pool);
  EXPECT_GE(coveredPercentage(range, truth), 99.8) << range.min << " .. " << range.max;
  EXPECT_GE(range.min, 35.0F);
  EXPECT_LE(range.max, 140.0F);
}

TEST(DisparityRange, IsWidenedWhereItReachesItsBound)
{
  const auto scene = render(25.0, 75.0, gridPositions(1, 3), {400, 160});
  ThreadPool pool(2);
  expectTight(findDisparityRange(scene.light_field, pool), scene.truth, 15.0);
}

TEST(DisparityRange, EndsAtInfinityWhereThatIsKnown)
{
  const auto scene = render(0.0, 8.0, gridPositions(1, 3), {256, 192});
  ThreadPool pool(2);
  DisparityRangeOptions options;
  EXPECT_LT(findDisparityRange(scene.light_field, pool, options).min, 0.0F);
  options.farthest_px = 0.0F;
  EXPECT_EQ(findDisparityRange(scene.light_field, pool, options).min, 0.0F);
  // Images that contradict it are believed.
  options.farthest_px = 5.0F;
  EXPECT_LT(findDisparityRange(scene.light_field, pool, options).min, 0.5F);
}

TEST(DisparityRange, IsMeasuredInGridSteps)
{
  auto scene = render(-1.0, 1.5, crossPositions(5, 5), {256, 192});
  ThreadPool pool(2);
  for (View& view : scene.light_field.views)
  {
    view.steps *= 4.0;
  }
  expectTight(findDisparityRange(scene.light_field, pool), scene.truth / 4.0, 0.25);
}

TEST(DisparityRange, ToleratesNoise)
{
  const auto scene = render(-1.5, 2.0, crossPositions(9, 9), {256, 192}, 8.0);
  ThreadPool pool(2);
  expectTight(findDisparityRange(scene.light_field, pool), scene.truth, 0.8);
}

TEST(DisparityRange, IsNotWidenedByRepeatedTexture)
{
  SceneSettings settings;
  settings.size = {256, 192};
  settings.positions = gridPositions(3, 3);
  settings.samples = 2;
  auto surfaces = layers(settings.size, 0.0, 6.0);
  surfaces.push_back(rectangle(3.0, {100, 20, 90, 60}, testing::checkerTexture(6.0)));
  const auto scene = renderScene(surfaces, settings);
  ThreadPool pool(2);
  expectTight(findDisparityRange(scene.light_field, pool), scene.truth, 2.0);
}

TEST(DisparityRange, IsNarrowWhereNothingHasTexture)
{
  SceneSettings settings;
  settings.positions = gridPositions(3, 3);
  settings.noise_sigma = 3.0;
  const auto scene = renderScene({plane(0, 0, 0, testing::constantTexture({90, 90, 90}))}, settings);
  ThreadPool pool(2);
  const DisparityRange range = findDisparityRange(scene.light_field, pool);
  EXPECT_LT(range.min, range.max);
  EXPECT_GT(range.min, -2.0F);
  EXPECT_LT(range.max, 2.0F);
}

TEST(DisparityRange, DoesNotDependOnTheNumberOfThreads)
{
  const auto scene = render(-1.5, 2.0, crossPositions(5, 5), {256, 192}, 4.0);
  ThreadPool one(1);
  ThreadPool three(3);
  const DisparityRange a = findDisparityRange(scene.light_field, one);
  const DisparityRange b = findDisparityRange(scene.light_field, three);
  EXPECT_EQ(a.min, b.min);
  EXPECT_EQ(a.max, b.max);
}

TEST(DisparityRange, TakesSixteenBitsAndTheSmallestViews)
{
  auto scene = render(-0.5, 0.5, gridPositions(3, 3), {16, 16});
  for (View& view : scene.light_field.views)
  {
    cv::Mat words;
    view.image.convertTo(words, CV_16U, 257.0);
    view.image = words;
  }
  ThreadPool pool(2);
  const DisparityRange range = findDisparityRange(scene.light_field, pool);
  EXPECT_LT(range.min, range.max);
}

TEST(DisparityRange, RejectsOptionsThatCannotBeUsed)
{
  EXPECT_TRUE(validate(DisparityRangeOptions{}).empty());
  EXPECT_EQ(validate(DisparityRangeOptions{0.0F, -1.0F, 0.0F, std::nullopt}).size(), 3U);
}

TEST(DisparityRange, LeavesTheViewsAsTheyAre)
{
  constexpr double NOISE_SIGMA = 5.0;  // enough for the search to smooth its own pictures
  for (const cv::Size size : {cv::Size(120, 90), cv::Size(400, 30)})
  {
    SceneSettings settings;
    settings.size = size;
    settings.positions = crossPositions(5, 5);
    settings.noise_sigma = NOISE_SIGMA;
    settings.grey = true;
    const SyntheticLightField scene = renderScene(layers(size, -1.0, 1.0), settings);
    std::vector<cv::Mat> before;
    for (const View& view : scene.light_field.views)
    {
      before.push_back(view.image.clone());
    }
    ThreadPool pool(2);
    findDisparityRange(scene.light_field, pool);
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      EXPECT_EQ(cv::norm(before[i], scene.light_field.views[i].image, cv::NORM_INF), 0.0)
          << "view " << i << " of " << size;
    }
  }
}

TEST(DisparityRange, CoversTheTruthOfTheBenchmarkScenes)
{
  ThreadPool pool(2);
  for (const std::string name : {"cotton", "antinous"})
  {
    const auto scene = testing::readBenchmarkScene(name);
    if (!scene)
    {
      GTEST_SKIP() << name << " is not in " << testing::BENCHMARK_SCENES;
    }
    for (const auto selection : {ViewSelection::All, ViewSelection::Row, ViewSelection::Cross})
    {
      SCOPED_TRACE(name + ", " + toString(selection));
      expectTight(findDisparityRange(selectViews(scene->light_field, selection), pool), scene->truth, 0.6);
    }
  }
}

TEST(DisparityRange, StaysNarrowWhenTheBenchmarkScenesAreNoisy)
{
  ThreadPool pool(2);
  for (const std::string name : {"cotton", "antinous"})
  {
    const auto scene = testing::readBenchmarkScene(name);
    if (!scene)
    {
      GTEST_SKIP() << name << " is not in " << testing::BENCHMARK_SCENES;
    }
    const LightField cross = selectViews(scene->light_field, ViewSelection::Cross);
    const std::size_t row = cross.reference_index;
    const LightField pair = makeLightField({cross.reference(), cross.views[row - 4]}, cross.reference().grid);
    double min = 0.0;
    double max = 0.0;
    cv::minMaxIdx(scene->truth, &min, &max);
    for (const double sigma : {3.0, 8.0})
    {
      for (const LightField& light_field : {cross, pair})
      {
        const DisparityRange range = findDisparityRange(testing::withNoise(light_field, sigma), pool);
        SCOPED_TRACE(name + ", " + std::to_string(light_field.views.size()) + " views, noise " +
                     std::to_string(sigma) + ": " + std::to_string(range.min) + " .. " +
                     std::to_string(range.max));
        EXPECT_GE(coveredPercentage(range, scene->truth), 98.0);
        EXPECT_GE(range.min, min - 1.0);
        EXPECT_LE(range.max, max + 1.0);
      }
    }
  }
}

}  // namespace
}  // namespace light_field_depth
