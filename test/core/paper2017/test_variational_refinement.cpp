#include <gtest/gtest.h>
#include <numeric>

#include "core/paper2017/sor_solver.h"
#include "core/paper2017/variational_refinement.h"
#include "light_field_depth/core/error.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
testing::SyntheticLightField scene(const std::vector<GridPosition>& positions)
{
  testing::SceneSettings settings;
  settings.positions = positions;
  return testing::renderScene({testing::plane(0.3, 0.004, -0.003, testing::noiseTexture(4, 16.0))}, settings);
}

std::vector<std::size_t> allViews(const LightField& light_field)
{
  std::vector<std::size_t> views(light_field.views.size());
  std::iota(views.begin(), views.end(), std::size_t{0});
  return views;
}

double errorAfter(const testing::SyntheticLightField& input, const cv::Mat& start)
{
  ThreadPool pool(2);
  const cv::Mat refined = refineDisparity(input.light_field, allViews(input.light_field), start, {}, pool);
  return testing::meanAbsoluteError(refined, input.truth);
}

TEST(SorSolver, SolvesTheSystem)
{
  const cv::Size size(13, 9);
  cv::RNG random(3);
  GridSystem system{cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32FC1),
                    cv::Mat(size, CV_32FC1)};
  for (cv::Mat* part : {&system.data, &system.link_right, &system.link_below, &system.right_side})
  {
    random.fill(*part, cv::RNG::UNIFORM, 0.1, 1.0);
  }
  cv::Mat values = cv::Mat::zeros(size, CV_32FC1);
  ThreadPool pool(2);
  solveBySor(system, 200, 1.5F, values, pool);
  const auto at = [&](int y, int x) { return values.at<float>(y, x); };
  for (int y = 0; y < size.height; ++y)
  {
    for (int x = 0; x < size.width; ++x)
    {
      float left_side = system.data.at<float>(y, x) * at(y, x);
      left_side += x + 1 < size.width ? system.link_right.at<float>(y, x) * (at(y, x) - at(y, x + 1)) : 0;
      left_side += x > 0 ? system.link_right.at<float>(y, x - 1) * (at(y, x) - at(y, x - 1)) : 0;
      left_side += y + 1 < size.height ? system.link_below.at<float>(y, x) * (at(y, x) - at(y + 1, x)) : 0;
      left_side += y > 0 ? system.link_below.at<float>(y - 1, x) * (at(y, x) - at(y - 1, x)) : 0;
      EXPECT_NEAR(left_side, system.right_side.at<float>(y, x), 1e-4);
    }
  }
}

TEST(VariationalRefinement, RemovesSubpixelErrorOnBothAxes)
{
  for (const auto& positions : {testing::gridPositions(1, 5), testing::gridPositions(5, 1)})
  {
    const auto input = scene(positions);
    EXPECT_LT(errorAfter(input, input.truth + 0.2), 0.02);
    EXPECT_LT(errorAfter(input, input.truth - 0.2), 0.02);
  }
}

TEST(VariationalRefinement, RemovesNoiseFromTheStart)
{
  const auto input = scene(testing::crossPositions(5, 5));
  cv::Mat noise(input.truth.size(), CV_32FC1);
  cv::RNG(5).fill(noise, cv::RNG::NORMAL, 0.0, 0.15);
  EXPECT_LT(errorAfter(input, input.truth + noise), 0.015);
}

TEST(VariationalRefinement, StaysNearTheTruth)
{
  const auto input = scene(testing::crossPositions(5, 5));
  EXPECT_LT(errorAfter(input, input.truth), 0.01);
}

TEST(VariationalRefinement, ChoosesViewsByTheirDistance)
{
  const auto input = scene(testing::crossPositions(5, 5));
  const LightField& light_field = input.light_field;
  const auto distances = [&](RefinementViews choice)
  {
    std::vector<double> result;
    for (const std::size_t i : refinementViews(light_field, allViews(light_field), choice))
    {
      result.push_back(cv::norm(light_field.views[i].steps));
    }
    return result;
  };
  EXPECT_EQ(distances(RefinementViews::Adjacent), (std::vector<double>{1, 1, 1, 1}));
  EXPECT_EQ(distances(RefinementViews::Outermost), (std::vector<double>{2, 2, 2, 2}));
  EXPECT_EQ(distances(RefinementViews::All).size(), 9U);
  EXPECT_EQ(refinementViewsFromString("outermost"), RefinementViews::Outermost);
  EXPECT_THROW(refinementViewsFromString("most"), InputError);
}

}  // namespace
}  // namespace light_field_depth
