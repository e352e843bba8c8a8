#include "core/multiview/pair.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "core/multiview/multiview_estimator.h"
#include "light_field_depth/io/pfm.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
using testing::noiseTexture;
using testing::plane;
using testing::rectangle;
using testing::SceneSettings;
using testing::SyntheticLightField;

const std::filesystem::path STEREO_PAIRS = "../shared/data/stereo";

/// A wall at `far`, a slanted box and a smaller one at `near`, seen by two cameras side by side, or the same
/// turned, by two above each other. The wall is seen on both sides of what each box hides.
SyntheticLightField renderPair(double far, double near, bool side_by_side = true)
{
  SceneSettings settings;
  settings.size = side_by_side ? cv::Size(320, 160) : cv::Size(160, 320);
  settings.positions = side_by_side ? testing::gridPositions(1, 2) : testing::gridPositions(2, 1);
  settings.reference = GridPosition{0, 0};
  settings.samples = 2;
  const double along = std::max(settings.size.width, settings.size.height);
  const double across = std::min(settings.size.width, settings.size.height);
  const auto turned = [&](const cv::Rect2d& area)
  { return side_by_side ? area : cv::Rect2d(area.y, area.x, area.height, area.width); };
  return testing::renderScene(
      {plane(far, 0.0, 0.0, noiseTexture(1, 16.0, {110, 130, 140})),
       rectangle(0.5 * (far + near), turned({0.45 * along, 0.1 * across, 0.3 * along, 0.35 * across}),
                 noiseTexture(2, 12.0, {150, 110, 90})),
       rectangle(near, turned({0.4 * along, 0.55 * across, 0.3 * along, 0.3 * across}),
                 noiseTexture(3, 10.0, {90, 120, 160}))},
      settings);
}

DisparityEstimate estimate(const LightField& light_field, MultiviewPreset preset = MultiviewPreset::Balanced)
{
  MultiviewOptions options;
  options.preset = preset;
  MultiviewEstimator estimator(options);
  ThreadPool pool(2);
  RunContext context(pool);
  return estimator.estimate(light_field, {}, context);
}

/// Of the pixels whose truth is positive.
double badOfKnown(const cv::Mat& disparity, const cv::Mat& truth, double threshold_px)
{
  int known = 0;
  int bad = 0;
  for (int y = 0; y < truth.rows; ++y)
  {
    for (int x = 0; x < truth.cols; ++x)
    {
      const float d = truth.at<float>(y, x);
      if (std::isfinite(d) && d > 0.0F)
      {
        ++known;
        bad += std::abs(disparity.at<float>(y, x) - d) > threshold_px ? 1 : 0;
      }
    }
  }
  return 100.0 * bad / known;
}

TEST(Pair, IsTurnedRound)
{
  LightField pair = renderPair(2.0, 9.0).light_field;
  pair.views[1].offset_px = {0.5, -0.25};
  const LightField turned = multiview::turnedRound(pair);
  EXPECT_EQ(turned.reference_index, 1U);
  EXPECT_EQ(turned.reference().steps, cv::Point2d());
  EXPECT_EQ(turned.reference().offset_px, cv::Point2d());
  EXPECT_EQ(multiview::otherView(turned).steps, cv::Point2d(-1.0, 0.0));
  EXPECT_EQ(multiview::otherView(turned).offset_px, cv::Point2d(-0.5, 0.25));
}

TEST(Pair, IsSolvedOverARangeThatIsFound)
{
  for (const bool side_by_side : {true, false})
  {
    SCOPED_TRACE(side_by_side ? "side by side" : "above each other");
    const auto scene = renderPair(12.0, 70.0, side_by_side);
    const DisparityEstimate result = estimate(scene.light_field);
    EXPECT_LE(result.range.min, 12.0F);
    EXPECT_GE(result.range.max, 70.0F);
    EXPECT_LT(result.range.max, 100.0F);
    EXPECT_LT(badOfKnown(result.disparity, scene.truth, 4.0), 3.0);
  }
}

TEST(Pair, FillsWhatOneViewHidesFromBehindWithoutConfidence)
{
  constexpr double FAR = 4.0;
  constexpr double NEAR = 24.0;
  const auto scene = renderPair(FAR, NEAR);
  const DisparityEstimate result = estimate(scene.light_field);
  // The strip of the wall to the left of the near box, which hides it from the right view.
  const cv::Rect strip(110, 96, 16, 32);
  EXPECT_LT(badOfKnown(result.disparity(strip), scene.truth(strip), 1.0), 5.0);
  EXPECT_GT(cv::countNonZero(result.confidence(strip) == 0.0F), 0.9 * strip.area());
  const cv::Rect seen(140, 100, 60, 24);  // on the near box
  EXPECT_EQ(cv::countNonZero(result.confidence(seen) == 0.0F), 0);
}

TEST(Pair, OfParallelCamerasHasNothingBehindInfinity)
{
  auto scene = renderPair(0.5, 20.0);
  scene.light_field.calibration = Calibration{};
  scene.light_field.calibration->focal_length_px = 300.0;
  scene.light_field.calibration->baseline_m = 0.1;
  EXPECT_GE(estimate(scene.light_field).range.min, 0.0F);
}

struct RealPair
{
  std::string folder;
  std::string left;
  std::string right;
  std::string truth;
  double truth_levels_per_px;  ///< of a PNG
  double most_bad_percent;     ///< off by more than 4 px, of all pixels with truth
  double most_bad_in_realtime;
};

TEST(Pair, OfRealCamerasIsSolved)
{
  const std::vector<RealPair> pairs = {{"eth3d_playground", "im0.png", "im1.png", "disp0.pfm", 1.0, 0.6, 0.8},
                                       {"art", "view1.png", "view5.png", "disp1.png", 3.0, 10.9, 14.0}};
  for (const RealPair& pair : pairs)
  {
    const std::filesystem::path folder = STEREO_PAIRS / pair.folder;
    if (!std::filesystem::exists(folder))
    {
      GTEST_SKIP() << pair.folder << " is not in " << STEREO_PAIRS;
    }
    std::vector<View> views = {gridView(0, 0, cv::imread((folder / pair.left).string(), cv::IMREAD_COLOR)),
                               gridView(0, 1, cv::imread((folder / pair.right).string(), cv::IMREAD_COLOR))};
    const LightField light_field = makeLightField(std::move(views), GridPosition{0, 0});
    cv::Mat truth;
    if (std::filesystem::path(pair.truth).extension() == ".pfm")
    {
      truth = readPfm(folder / pair.truth);
    }
    else
    {
      cv::imread((folder / pair.truth).string(), cv::IMREAD_GRAYSCALE)
          .convertTo(truth, CV_32F, 1.0 / pair.truth_levels_per_px);
    }
    EXPECT_LT(badOfKnown(estimate(light_field).disparity, truth, 4.0), pair.most_bad_percent) << pair.folder;
    EXPECT_LT(badOfKnown(estimate(light_field, MultiviewPreset::Realtime).disparity, truth, 4.0),
              pair.most_bad_in_realtime)
        << pair.folder;
  }
}

}  // namespace
}  // namespace light_field_depth
