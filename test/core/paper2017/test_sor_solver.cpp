#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/paper2017/sor_solver.h"

namespace light_field_depth
{
namespace
{
GridSystem randomSystem(const cv::Size& size)
{
  cv::RNG random(3);
  GridSystem system;
  for (cv::Mat* const part : {&system.data, &system.link_right, &system.link_below, &system.right_side})
  {
    part->create(size, CV_32FC1);
    random.fill(*part, cv::RNG::UNIFORM, 0.1, 1.0);
  }
  return system;
}

/// Largest error of an equation.
double residual(const GridSystem& system, const cv::Mat& u)
{
  double largest = 0.0;
  for (int y = 0; y < u.rows; ++y)
  {
    for (int x = 0; x < u.cols; ++x)
    {
      double left_side = system.data.at<float>(y, x) * u.at<float>(y, x);
      const auto add = [&](float link, int other_y, int other_x)
      { left_side += link * (u.at<float>(y, x) - u.at<float>(other_y, other_x)); };
      if (x > 0)
      {
        add(system.link_right.at<float>(y, x - 1), y, x - 1);
      }
      if (x + 1 < u.cols)
      {
        add(system.link_right.at<float>(y, x), y, x + 1);
      }
      if (y > 0)
      {
        add(system.link_below.at<float>(y - 1, x), y - 1, x);
      }
      if (y + 1 < u.rows)
      {
        add(system.link_below.at<float>(y, x), y + 1, x);
      }
      largest = std::max(largest, std::abs(left_side - system.right_side.at<float>(y, x)));
    }
  }
  return largest;
}

TEST(SorSolver, SolvesTheSystemOnAnyNumberOfThreads)
{
  const cv::Size size(37, 41);
  const GridSystem system = randomSystem(size);
  cv::Mat one = cv::Mat::zeros(size, CV_32FC1);
  cv::Mat three = one.clone();
  ThreadPool single(1);
  ThreadPool several(3);
  solveBySor(system, 60, 1.2F, one, single);
  solveBySor(system, 60, 1.2F, three, several);
  EXPECT_LT(residual(system, one), 1e-5);
  EXPECT_EQ(cv::norm(one, three, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace light_field_depth
