#include "core/multiview/solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/synthetic_scene.h"

namespace light_field_depth::multiview
{
namespace
{
/// A cross whose outermost views stand four steps from the reference, as the solver expects.
const testing::SyntheticLightField& scene()
{
  static const testing::SyntheticLightField rendered = []
  {
    testing::SceneSettings settings;
    settings.size = {128, 96};
    settings.positions = testing::crossPositions(9, 9);
    settings.samples = 2;
    return testing::renderScene(testing::standardScene(settings.size), settings);
  }();
  return rendered;
}

SolverSettings settingsOfScene()
{
  SolverSettings settings;
  settings.range = {-1.4F, 2.2F};
  return settings;
}

cv::Mat solved(const SolverSettings& settings, int threads = 2)
{
  ThreadPool pool(threads);
  RunContext context(pool);
  Solver solver;
  solver.run(scene().light_field, settings, context);
  return solver.disparity().clone();
}

TEST(Solver, FindsTheStandardSceneInColourAndGrey)
{
  SolverSettings settings = settingsOfScene();
  EXPECT_LT(testing::badPercentage(solved(settings), scene().truth, 0.07), 8.0);
  settings.grey_search = true;
  EXPECT_LT(testing::badPercentage(solved(settings), scene().truth, 0.07), 12.0);
}

TEST(Solver, RunsTheStagesThatTheSettingsName)
{
  ThreadPool pool(2);
  RunContext context(pool);
  SolverSettings settings = settingsOfScene();
  settings.search.visibility_passes = 0;
  settings.search.fuse_background = false;
  settings.decide_boundary_pixels = false;
  Solver solver;
  solver.run(scene().light_field, settings, context);
  const auto ran = [&](const std::string& name)
  {
    return std::any_of(context.stage_times.begin(), context.stage_times.end(),
                       [&](const StageTime& time) { return time.stage == name; });
  };
  EXPECT_TRUE(ran("cost"));
  EXPECT_TRUE(ran("linearize"));
  EXPECT_TRUE(ran("confidence"));
  EXPECT_FALSE(ran("visibility"));
  EXPECT_FALSE(ran("background"));
  EXPECT_FALSE(ran("boundary_pixels"));
}

TEST(Solver, NearAMapItFindsTheSame)
{
  ThreadPool pool(2);
  RunContext context(pool);
  Solver solver;
  solver.runNear(scene().light_field, settingsOfScene(), scene().truth, context);
  EXPECT_LT(testing::badPercentage(solver.disparity(), scene().truth, 0.07), 8.0);
}

TEST(Solver, TheNextFrameFollowsAndAnotherSceneDoesNot)
{
  ThreadPool pool(2);
  RunContext context(pool);
  SolverSettings settings = settingsOfScene();
  settings.search.detect_changes = true;
  Solver solver;
  solver.run(scene().light_field, settings, context);
  EXPECT_TRUE(solver.follow(scene().light_field, settings, context));
  EXPECT_LT(testing::badPercentage(solver.disparity(), scene().truth, 0.07), 8.0);
  LightField other = scene().light_field;
  cv::RNG random(6);
  for (View& view : other.views)
  {
    cv::Mat noise(view.image.size(), view.image.type());
    random.fill(noise, cv::RNG::UNIFORM, 0, 256);
    view.image = noise;
  }
  EXPECT_FALSE(solver.follow(other, settings, context));
}

TEST(Solver, ResultsHaveTheSizeOfTheViewsAndDoNotDependOnThreads)
{
  ThreadPool pool(1);
  RunContext context(pool);
  Solver solver;
  solver.run(scene().light_field, settingsOfScene(), context);
  EXPECT_EQ(solver.confidence().size(), scene().light_field.size());
  EXPECT_EQ(solver.filled().size(), scene().light_field.size());
  double least = 0.0;
  double most = 0.0;
  cv::minMaxIdx(solver.confidence(), &least, &most);
  EXPECT_GE(least, 0.0);
  EXPECT_LE(most, 1.0);
  EXPECT_EQ(cv::norm(solver.disparity(), solved(settingsOfScene(), 3), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace light_field_depth::multiview
