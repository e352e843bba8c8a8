#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "core/light_field/half_resolution.h"
#include "core/light_field/view_set.h"
#include "core/multiview/maps/upsampling.h"
#include "core/multiview/multiview_estimator.h"
#include "core/preprocess/even_exposure.h"
#include "support/instruction_sets.h"
#include "support/synthetic_scene.h"

namespace light_field_depth::multiview
{
namespace
{
std::vector<std::uint8_t> randomBytes(std::size_t count)
{
  std::mt19937 engine(5);
  std::uniform_int_distribution<int> any(0, 255);
  std::vector<std::uint8_t> bytes(count);
  for (auto& byte : bytes)
  {
    byte = static_cast<std::uint8_t>(any(engine));
  }
  return bytes;
}

class HalfResolutionRows : public testing::InstructionSetTest
{
};

TEST_P(HalfResolutionRows, EqualThePlainVersion)
{
  for (const int channels : {1, 3})
  {
    for (const int width : {1, 7, 64, 203})
    {
      const auto count = 2 * static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
      const auto pixels = randomBytes(2 * count);
      std::vector<std::uint8_t> fast(static_cast<std::size_t>(width));
      std::vector<std::uint8_t> plain(fast.size());
      halveRow(pixels.data(), pixels.data() + count, channels, width, fast.data());
      halveRowPlain(pixels.data(), pixels.data() + count, channels, width, plain.data());
      EXPECT_EQ(fast, plain) << channels << " channels, width " << width;
    }
  }
}

TEST_P(HalfResolutionRows, OfAllChannelsEqualThePlainVersion)
{
  for (const int channels : {1, 3})
  {
    for (const int width : {1, 7, 64, 203})
    {
      const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
      const auto pixels = randomBytes(4 * count);
      std::vector<std::uint8_t> fast(count);
      std::vector<std::uint8_t> plain(count);
      halveChannelsRow(pixels.data(), pixels.data() + 2 * count, channels, width, fast.data());
      halveChannelsRowPlain(pixels.data(), pixels.data() + 2 * count, channels, width, plain.data());
      EXPECT_EQ(fast, plain) << channels << " channels, width " << width;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, HalfResolutionRows, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST(HalfResolution, KeepsColoursAndLeavesOddEndsOut)
{
  for (const int type : {CV_8UC1, CV_8UC3})
  {
    const cv::Size size(203, 41);
    cv::Mat image(size, type);
    cv::RNG random(6);
    random.fill(image, cv::RNG::UNIFORM, 0, 256);
    cv::Mat half;
    halveChannels(image, half);
    cv::Mat expected;
    cv::resize(image(cv::Rect(0, 0, 202, 40)), expected, cv::Size(101, 20), 0, 0, cv::INTER_AREA);
    ASSERT_EQ(half.size(), expected.size());
    EXPECT_EQ(cv::norm(half, expected, cv::NORM_INF), 0.0);
  }
}

TEST(HalfResolution, IsTheMeanBrightnessOfFourPixels)
{
  auto settings = testing::SceneSettings();
  settings.positions = testing::crossPositions(3, 3);
  settings.size = {75, 41};
  const auto input = testing::renderScene(testing::standardScene(settings.size), settings);
  ThreadPool pool(2);
  HalfResolution reducer;
  const LightField& half = reducer.reduce(input.light_field, pool);
  ASSERT_EQ(half.views.size(), input.light_field.views.size());
  for (std::size_t i = 0; i < half.views.size(); ++i)
  {
    const View& view = input.light_field.views[i];
    cv::Mat grey;
    cv::Mat expected;
    cv::cvtColor(view.image, grey, cv::COLOR_BGR2GRAY);
    cv::resize(grey(cv::Rect(0, 0, 74, 40)), expected, {37, 20}, 0, 0, cv::INTER_AREA);
    EXPECT_LE(cv::norm(half.views[i].image, expected, cv::NORM_INF), 1.0);
    EXPECT_EQ(half.views[i].steps, 0.5 * view.steps);
  }
}

/// A slanted plane, and from a column on another one that is nearer; the image shows the border.
struct Step
{
  static constexpr int BORDER = 33;  // odd: in the middle of a reduced pixel
  cv::Mat image = cv::Mat(48, 70, CV_8UC3, cv::Scalar(40, 60, 80));
  cv::Mat truth = cv::Mat(48, 70, CV_32FC1);
  cv::Mat half = cv::Mat(24, 35, CV_32FC1);

  static float at(double x, double y) { return static_cast<float>((x >= BORDER ? 1.5 : 0.0) + 0.01 * y); }

  Step()
  {
    image.colRange(BORDER, image.cols).setTo(cv::Scalar(180, 150, 120));
    for (int y = 0; y < truth.rows; ++y)
    {
      for (int x = 0; x < truth.cols; ++x)
      {
        truth.at<float>(y, x) = at(x, y);
        half.at<float>(y / 2, x / 2) = at(x - x % 2 + 0.5, y - y % 2 + 0.5);
      }
    }
  }
};

TEST(Upsampling, FollowsTheEdgeOfTheImageAndThePlanesBesideIt)
{
  const Step step;
  const cv::Mat half_confidence(step.half.size(), CV_32FC1, 0.5F);
  ThreadPool pool(2);
  cv::Mat disparity;
  cv::Mat confidence;
  upsample(step.half, half_confidence, step.image, {}, pool, disparity, confidence);
  ASSERT_EQ(disparity.size(), step.truth.size());
  const cv::Rect inner(2, 4, 66, 40);
  EXPECT_LT(cv::norm(disparity(inner), step.truth(inner), cv::NORM_INF), 0.02);
  EXPECT_EQ(cv::norm(confidence, cv::Mat(confidence.size(), CV_32FC1, 0.5F), cv::NORM_INF), 0.0);
}

TEST(Upsampling, TakesImagesOfOddSizesAndGrey)
{
  const cv::Mat image(17, 33, CV_8UC1, 90);
  const cv::Mat half(8, 16, CV_32FC1, -0.75F);
  ThreadPool pool(1);
  cv::Mat disparity;
  cv::Mat confidence;
  upsample(half, half, image, {}, pool, disparity, confidence);
  EXPECT_EQ(cv::norm(disparity, cv::Mat(17, 33, CV_32FC1, -0.75F), cv::NORM_INF), 0.0);
}

DisparityEstimate estimateFast(const LightField& light_field, int threads)
{
  MultiviewOptions options;
  options.preset = MultiviewPreset::Fast;
  MultiviewEstimator estimator(options);
  ThreadPool pool(threads);
  RunContext context(pool);
  return estimator.estimate(light_field, {}, context);
}

TEST(FastPreset, SolvesTheStandardSceneInPixelsOfTheFullResolution)
{
  testing::SceneSettings settings;
  settings.positions = testing::crossPositions(9, 9);
  settings.size = {255, 192};
  const auto input = testing::renderScene(testing::standardScene(settings.size), settings);
  const auto one = estimateFast(input.light_field, 1);
  EXPECT_EQ(one.disparity.size(), settings.size);
  EXPECT_EQ(one.confidence.size(), settings.size);
  EXPECT_TRUE(cv::checkRange(one.disparity));
  EXPECT_LT(testing::meanAbsoluteError(one.disparity, input.truth), 0.06);
  EXPECT_LT(testing::badPercentage(one.disparity, input.truth, 0.2), 4.0);
  const auto many = estimateFast(input.light_field, 3);
  EXPECT_EQ(cv::norm(one.disparity, many.disparity, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(one.confidence, many.confidence, cv::NORM_INF), 0.0);
}

TEST(FastPreset, TakesTheSmallestViews)
{
  testing::SceneSettings settings;
  settings.positions = testing::crossPositions(3, 3);
  for (const int side : {16, 33})
  {
    settings.size = {side, side};
    const auto input = testing::renderScene(testing::standardScene(settings.size), settings);
    const auto result = estimateFast(input.light_field, 2);
    EXPECT_EQ(result.disparity.size(), settings.size);
    EXPECT_TRUE(cv::checkRange(result.disparity));
  }
}

TEST(FastPreset, MakesUpForExposureThatDiffers)
{
  testing::SceneSettings settings;
  settings.positions = testing::crossPositions(5, 5);
  settings.size = {256, 192};
  const auto even = testing::renderScene(testing::standardScene(settings.size), settings);
  settings.degrade = [](const GridPosition& position, cv::Mat& values)
  { values *= 1.0 + 0.04 * (position.column - 2); };
  const auto uneven = testing::renderScene(testing::standardScene(settings.size), settings);
  const double bad_even =
      testing::badPercentage(estimateFast(even.light_field, 2).disparity, even.truth, 0.2);
  const double bad_uneven =
      testing::badPercentage(estimateFast(uneven.light_field, 2).disparity, uneven.truth, 0.2);
  EXPECT_LT(bad_uneven, 1.5 * bad_even + 1.0);
}

TEST(EvenExposure, IsAMeanBrightnessAndWhatParallaxAdds)
{
  testing::SceneSettings settings;
  settings.grey = true;
  settings.positions = testing::crossPositions(5, 5);
  auto input = testing::renderScene(testing::standardScene(settings.size), settings);
  EXPECT_TRUE(looksEvenlyExposed(input.light_field));
  cv::Mat& image = input.light_field.views.front().image;
  image.convertTo(image, -1, 1.05, 0.0);
  EXPECT_FALSE(looksEvenlyExposed(input.light_field));
}

TEST(ThinnedArms, KeepTheNearestTheFarthestAndTheReference)
{
  testing::SceneSettings settings;
  settings.size = {32, 32};
  settings.positions = testing::crossPositions(9, 9);
  const auto input = testing::renderScene(testing::standardScene(settings.size), settings);
  const LightField thinned = withThinnedArms(input.light_field, 2);
  ASSERT_EQ(thinned.views.size(), 9U);
  EXPECT_EQ(thinned.reference().grid, (GridPosition{4, 4}));
  std::vector<int> rows;
  for (const View& view : thinned.views)
  {
    rows.push_back(view.grid.row);
  }
  EXPECT_EQ(rows, (std::vector<int>{0, 3, 4, 4, 4, 4, 4, 5, 8}));
}

}  // namespace
}  // namespace light_field_depth::multiview
