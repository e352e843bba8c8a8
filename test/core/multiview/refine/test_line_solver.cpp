#include "core/multiview/refine/line_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/multiview/refine/smoothing_system.h"

namespace light_field_depth::multiview
{
namespace
{
using testing::equal;
using testing::SmoothingSystem;

/// What is left of the derivative of the energy with respect to a value, over 2.
double residual(const SmoothingSystem& system, const cv::Mat& values, int x, int y)
{
  const auto at = [&](int column, int row) { return static_cast<double>(values.at<float>(row, column)); };
  double sum = system.weight.at<float>(y, x) * (at(x, y) - system.target.at<float>(y, x));
  sum += x > 0 ? system.left.at<float>(y, x) * (at(x, y) - at(x - 1, y)) : 0.0;
  sum += x + 1 < values.cols ? system.left.at<float>(y, x + 1) * (at(x, y) - at(x + 1, y)) : 0.0;
  sum += y > 0 ? system.up.at<float>(y, x) * (at(x, y) - at(x, y - 1)) : 0.0;
  sum += y + 1 < values.rows ? system.up.at<float>(y + 1, x) * (at(x, y) - at(x, y + 1)) : 0.0;
  return sum;
}

double largestResidual(const SmoothingSystem& system, const cv::Mat& values)
{
  double largest = 0.0;
  for (int y = 0; y < values.rows; ++y)
  {
    for (int x = 0; x < values.cols; ++x)
    {
      largest = std::max(largest, std::abs(residual(system, values, x, y)));
    }
  }
  return largest;
}

LinkedGrid gridOf(const SmoothingSystem& system, cv::Mat& values)
{
  return {system.weight, system.target, system.left, system.up, values};
}

TEST(LineSolver, RowsAloneAreSolvedInOneGo)
{
  SmoothingSystem system(150, 61);
  system.up.setTo(0.0F);
  cv::Mat values = system.disparity.clone();
  ThreadPool pool(2);
  LineSolver solver;
  solver.solveRows(gridOf(system, values), {}, pool);
  EXPECT_LT(largestResidual(system, values), 0.01);  // of weights and links of hundreds
}

TEST(LineSolver, ColumnsAloneAreSolvedInOneGo)
{
  SmoothingSystem system(70, 203);
  system.left.setTo(0.0F);
  cv::Mat values = system.disparity.clone();
  ThreadPool pool(2);
  LineSolver solver;
  solver.solveColumns(gridOf(system, values), pool);
  EXPECT_LT(largestResidual(system, values), 0.01);
}

TEST(LineSolver, RowsAndColumnsInTurnReachTheMinimum)
{
  const SmoothingSystem system(83, 140);
  cv::Mat values = system.disparity.clone();
  ThreadPool pool(2);
  LineSolver solver;
  for (int i = 0; i < 60; ++i)
  {
    solver.solveRows(gridOf(system, values), {}, pool);
    solver.solveColumns(gridOf(system, values), pool);
  }
  EXPECT_LT(largestResidual(system, values), 0.05);
}

TEST(LineSolver, EveryBandIsPreparedBeforeItAndTheRowAboveItChange)
{
  const SmoothingSystem system(150, 20);
  cv::Mat values = system.disparity.clone();
  std::vector<int> prepared(150, 0);
  ThreadPool pool(3);
  LineSolver solver;
  solver.solveRows(
      gridOf(system, values),
      [&](int first, int last)
      {
        for (int y = first; y < last; ++y)
        {
          ++prepared[static_cast<std::size_t>(y)];
        }
        for (int y = std::max(first - 1, 0); y < last; ++y)
        {
          EXPECT_TRUE(equal(values.row(y), system.disparity.row(y))) << y;
        }
      },
      pool);
  EXPECT_EQ(prepared, std::vector<int>(150, 1));
}

TEST(LineSolver, IsTheSameOnAnyNumberOfThreads)
{
  const SmoothingSystem system(150, 203);
  std::vector<cv::Mat> results;
  for (const int threads : {1, 3})
  {
    ThreadPool pool(threads);
    cv::Mat values = system.disparity.clone();
    LineSolver solver;
    solver.solveRows(gridOf(system, values), {}, pool);
    solver.solveColumns(gridOf(system, values), pool);
    results.push_back(values);
  }
  EXPECT_TRUE(equal(results[0], results[1]));
}

}  // namespace
}  // namespace light_field_depth::multiview
