#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/multiview/multiview_estimator.h"
#include "light_field_depth/core/cancellation.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
using testing::SceneSettings;
using testing::Surface;
using testing::SyntheticLightField;
using testing::Texture;

const cv::Size SIZE(224, 160);
constexpr int FRAMES = 50;
constexpr int CUT = 25;
constexpr int APPEARANCE = 38;
/// Where the object appears, within the range but far from what was there.
const cv::Rect APPEARING(24, 90, 44, 40);

/// A texture that is carried along.
Texture moved(const Texture& texture, double dx, double dy)
{
  return [=](double x, double y) { return texture(x - dx, y - dy); };
}

/// A rectangle of a slanted plane that turns about its middle.
Surface turning(double disparity, cv::Point2d middle, double half_side, double angle, const Texture& texture)
{
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const auto local = [=](double x, double y)
  { return cv::Point2d(c * (x - middle.x) + s * (y - middle.y), -s * (x - middle.x) + c * (y - middle.y)); };
  return {[=](double x, double y) { return disparity + 0.004 * local(x, y).x; },
          [=](double x, double y)
          { return std::abs(local(x, y).x) < half_side && std::abs(local(x, y).y) < half_side; },
          [=](double x, double y) { return texture(local(x, y).x, local(x, y).y); }};
}

/// A background that glides, a turning square, a square that comes nearer, a thin bar that runs across; other
/// places, speeds, and colours after the cut.
std::vector<Surface> sceneAt(int frame)
{
  const bool before = frame < CUT;
  const double t = before ? frame : frame - CUT;
  const unsigned seed = before ? 10 : 40;
  const cv::Vec3f tint = before ? cv::Vec3f(150, 110, 90) : cv::Vec3f(90, 140, 160);
  std::vector<Surface> scene;
  scene.push_back(testing::plane(before ? -1.0 : -0.4, 0.002, before ? 0.004 : -0.003,
                                 moved(testing::noiseTexture(seed, 20.0), 0.7 * t, 0.3 * t)));
  scene.push_back(turning(before ? 0.4 : 0.9, {before ? 70.0 : 150.0, 60.0}, 32.0, 0.03 * t,
                          testing::noiseTexture(seed + 1, 14.0, tint)));
  const double x = (before ? 120.0 : 20.0) + 1.5 * t;
  scene.push_back(testing::rectangle(0.7 + 0.02 * t, {x, before ? 90.0 : 30.0, 50.0, 44.0},
                                     moved(testing::noiseTexture(seed + 2, 12.0, tint), 1.5 * t, 0.0)));
  const double bar = (before ? 20.0 : 200.0) + (before ? 4.0 : -4.0) * t;
  scene.push_back(testing::rectangle(before ? 1.6 : 2.4, {bar, 10.0, 6.0, 130.0},
                                     moved(testing::noiseTexture(seed + 3, 10.0, {60, 60, 190}), bar, 0.0)));
  if (frame >= APPEARANCE)
  {
    scene.push_back(testing::rectangle(1.3, APPEARING, testing::noiseTexture(99, 12.0, {60, 180, 60})));
  }
  return scene;
}

SyntheticLightField frameAt(int frame)
{
  SceneSettings settings;
  settings.size = SIZE;
  for (const GridPosition& position : testing::crossPositions(9, 9))
  {
    if (position.row % 2 == 0 && position.column % 2 == 0)
    {
      settings.positions.push_back(position);
    }
  }
  settings.samples = 2;
  return testing::renderScene(sceneAt(frame), settings);
}

/// An estimator that sees the frames of a video.
class Player
{
public:
  explicit Player(bool temporal, int threads = 2, MultiviewPreset preset = MultiviewPreset::Realtime)
      : pool_(threads)
  {
    options_.temporal = temporal;
    options_.preset = preset;
    estimator_.setOptions(options_);
  }

  cv::Mat see(const LightField& light_field)
  {
    RunContext context(pool_);
    const auto start = std::chrono::steady_clock::now();
    const DisparityEstimate estimate = estimator_.estimate(light_field, request_, context);
    milliseconds_ =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    searched_in_full_ = std::any_of(context.stage_times.begin(), context.stage_times.end(),
                                    [](const StageTime& time) { return time.stage == "range"; });
    return estimate.disparity;
  }

  double milliseconds() const { return milliseconds_; }
  /// Whether the last frame's range was found, as happens with frames that do not follow.
  bool searchedInFull() const { return searched_in_full_; }
  MultiviewEstimator& estimator() { return estimator_; }
  MultiviewOptions& options() { return options_; }

private:
  ThreadPool pool_;
  EstimateRequest request_;
  MultiviewOptions options_;
  MultiviewEstimator estimator_;
  double milliseconds_ = 0.0;
  bool searched_in_full_ = false;
};

double meanSquareError(const cv::Mat& disparity, const cv::Mat& truth, const cv::Rect& area)
{
  const double norm = cv::norm(disparity(area), truth(area), cv::NORM_L2);
  return norm * norm / area.area();
}

struct FrameErrors
{
  double mse_alone = 0.0;
  double mse_temporal = 0.0;
  double bad_alone = 0.0;
  double bad_temporal = 0.0;
};

double meanOf(const std::vector<FrameErrors>& errors, int first, int last, double FrameErrors::*field)
{
  double sum = 0.0;
  for (int i = first; i < last; ++i)
  {
    sum += errors[static_cast<std::size_t>(i)].*field;
  }
  return sum / (last - first);
}

TEST(Temporal, IsAsAccurateAsFrameByFrameThroughMotionACutAndAnAppearance)
{
  constexpr int border = 8;
  const cv::Rect inner(border, border, SIZE.width - 2 * border, SIZE.height - 2 * border);
  Player alone(false);
  Player temporal(true);
  std::vector<FrameErrors> errors;
  std::vector<double> ratios;
  for (int frame = 0; frame < FRAMES; ++frame)
  {
    const auto input = frameAt(frame);
    const cv::Mat by_itself = alone.see(input.light_field);
    const cv::Mat followed = temporal.see(input.light_field);
    errors.push_back({meanSquareError(by_itself, input.truth, inner),
                      meanSquareError(followed, input.truth, inner),
                      testing::badPercentage(by_itself, input.truth, 0.07),
                      testing::badPercentage(followed, input.truth, 0.07)});
    const FrameErrors& here = errors.back();
    EXPECT_LT(here.mse_temporal, 1.15 * here.mse_alone + 1e-4) << "frame " << frame;
    if (frame == 0 || frame == CUT)
    {
      EXPECT_TRUE(temporal.searchedInFull()) << "frame " << frame;
      EXPECT_EQ(cv::norm(by_itself, followed, cv::NORM_INF), 0.0) << "frame " << frame;
    }
    if (frame == APPEARANCE)
    {
      EXPECT_LT(meanSquareError(followed, input.truth, APPEARING),
                1.03 * meanSquareError(by_itself, input.truth, APPEARING) + 1e-4);
    }
    if (!temporal.searchedInFull())
    {
      ratios.push_back(temporal.milliseconds() / alone.milliseconds());
    }
  }
  for (const int first : {CUT - 10, FRAMES - 10})
  {
    EXPECT_LT(meanOf(errors, first, first + 10, &FrameErrors::mse_temporal),
              1.03 * meanOf(errors, first, first + 10, &FrameErrors::mse_alone));
    EXPECT_LT(meanOf(errors, first, first + 10, &FrameErrors::bad_temporal),
              1.03 * meanOf(errors, first, first + 10, &FrameErrors::bad_alone));
  }
  EXPECT_GE(ratios.size(), static_cast<std::size_t>(FRAMES - 8));
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2),
                   ratios.end());
  EXPECT_LT(ratios[ratios.size() / 2], 0.8);
}

TEST(Temporal, DoesNotDependOnTheNumberOfThreads)
{
  for (const MultiviewPreset preset :
       {MultiviewPreset::Balanced, MultiviewPreset::Realtime, MultiviewPreset::Fast})
  {
    Player one(true, 1, preset);
    Player many(true, 3, preset);
    for (const int frame : {36, 37, APPEARANCE, APPEARANCE + 1})
    {
      const auto input = frameAt(frame);
      EXPECT_EQ(cv::norm(one.see(input.light_field), many.see(input.light_field), cv::NORM_INF), 0.0)
          << toString(preset) << ", frame " << frame;
      EXPECT_EQ(one.searchedInFull(), many.searchedInFull());
    }
  }
}

TEST(Temporal, BeginsAgainWhereTheViewsOrTheSettingsChange)
{
  const auto input = frameAt(3);
  const auto next = frameAt(4);
  Player player(true);
  player.see(input.light_field);
  player.see(next.light_field);
  EXPECT_FALSE(player.searchedInFull());

  LightField fewer = selectViews(next.light_field, ViewSelection::Row);
  player.see(fewer);
  EXPECT_TRUE(player.searchedInFull()) << "other views";
  player.see(next.light_field);
  EXPECT_TRUE(player.searchedInFull()) << "all views again";

  LightField elsewhere = next.light_field;
  elsewhere.views.back().offset_px.x += 0.25;
  player.see(elsewhere);
  EXPECT_TRUE(player.searchedInFull()) << "another calibration";

  player.options().refinements = 2;
  player.estimator().setOptions(player.options());
  player.see(elsewhere);
  EXPECT_TRUE(player.searchedInFull()) << "other settings";
  player.see(elsewhere);
  EXPECT_FALSE(player.searchedInFull());
}

TEST(Temporal, BeginsAgainAfterFramesThatWereSolvedAlone)
{
  Player player(true);
  const LightField frame = frameAt(0).light_field;
  const cv::Mat first = player.see(frame);
  SceneSettings smaller;
  smaller.size = {96, 64};
  smaller.positions = testing::crossPositions(5, 5);
  for (const LightField& alone : {testing::renderScene(sceneAt(0), smaller).light_field, frame})
  {
    player.options().temporal = false;
    player.estimator().setOptions(player.options());
    player.see(alone);
    player.options().temporal = true;
    player.estimator().setOptions(player.options());
    const cv::Mat again = player.see(frame);
    EXPECT_TRUE(player.searchedInFull());
    EXPECT_EQ(cv::norm(first, again, cv::NORM_INF), 0.0);
  }
}

TEST(Temporal, BeginsAgainAfterAFrameThatWasStopped)
{
  const auto input = frameAt(3);
  const auto next = frameAt(4);
  MultiviewOptions options;
  options.temporal = true;
  options.preset = MultiviewPreset::Realtime;
  MultiviewEstimator estimator(options);
  ThreadPool pool(2);
  const auto see = [&](const LightField& light_field)
  {
    RunContext context(pool);
    return estimator.estimate(light_field, {}, context).disparity;
  };
  const cv::Mat alone = see(next.light_field);
  see(input.light_field);
  CancellationToken stop;
  stop.cancel();
  pool.setCancellation(&stop);
  EXPECT_THROW(see(next.light_field), Cancelled);
  pool.setCancellation(nullptr);
  EXPECT_EQ(cv::norm(see(next.light_field), alone, cv::NORM_INF), 0.0);
}

TEST(Temporal, AFrameThatComesTwiceKeepsItsResult)
{
  const auto input = frameAt(30);
  Player player(true);
  const cv::Mat first = player.see(input.light_field);
  for (int i = 0; i < 3; ++i)
  {
    const cv::Mat again = player.see(input.light_field);
    EXPECT_FALSE(player.searchedInFull());
    EXPECT_LT(cv::norm(again, first, cv::NORM_L1) / static_cast<double>(first.total()), 0.002);
  }
}

}  // namespace
}  // namespace light_field_depth
