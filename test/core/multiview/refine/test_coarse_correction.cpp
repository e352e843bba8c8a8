#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/refine/coarse_correction.h"

namespace light_field_depth::multiview
{
namespace
{
/// A large area without data between two columns that know their value.
struct Membrane
{
  explicit Membrane(const cv::Size& size)
      : weight(cv::Mat::zeros(size, CV_32FC1)), target(cv::Mat::zeros(size, CV_32FC1)),
        left(size.height, size.width + 1, CV_32FC1, cv::Scalar(10.0F)),
        up(size.height + 1, size.width, CV_32FC1, cv::Scalar(10.0F)), values(cv::Mat::zeros(size, CV_32FC1))
  {
    left.col(0).setTo(0.0F);
    left.col(size.width).setTo(0.0F);
    up.row(0).setTo(0.0F);
    up.row(size.height).setTo(0.0F);
    weight.col(0).setTo(400.0F);
    weight.col(size.width - 1).setTo(400.0F);
    target.col(size.width - 1).setTo(1.0F);
  }
  LinkedGrid grid() { return {weight, target, left, up, values}; }

  double energy() const
  {
    double sum = 0.0;
    for (int y = 0; y < values.rows; ++y)
    {
      for (int x = 0; x < values.cols; ++x)
      {
        const double here = values.at<float>(y, x);
        sum += weight.at<float>(y, x) * std::pow(here - target.at<float>(y, x), 2);
        sum += x > 0 ? left.at<float>(y, x) * std::pow(here - values.at<float>(y, x - 1), 2) : 0.0;
        sum += y > 0 ? up.at<float>(y, x) * std::pow(here - values.at<float>(y - 1, x), 2) : 0.0;
      }
    }
    return sum;
  }

  cv::Mat weight, target, left, up, values;
};

TEST(CoarseCorrection, NeverRaisesTheEnergy)
{
  for (const cv::Size& size : {cv::Size(203, 150), cv::Size(64, 9), cv::Size(17, 130), cv::Size(8, 100)})
  {
    Membrane membrane(size);
    cv::randu(membrane.weight, 0.0F, 20.0F);
    cv::randu(membrane.target, -1.0F, 1.0F);
    cv::randu(membrane.values, -1.0F, 1.0F);
    const double before = membrane.energy();
    ThreadPool pool(1);
    CoarseCorrection().correct(membrane.grid(), pool);
    if (std::min(size.width, size.height) > CoarseCorrection::SMALLEST_SIDE_PX)
    {
      EXPECT_LT(membrane.energy(), 0.999 * before) << size;
    }
    else
    {
      EXPECT_EQ(membrane.energy(), before) << size;
    }
  }
}

/// Two corners know the value of all the rest; sweeps along lines alone bring it hardly beyond their rows
/// and columns.
TEST(CoarseCorrection, ReachesAcrossAnAreaWithoutData)
{
  Membrane membrane({200, 200});
  membrane.weight.setTo(0.0F);
  membrane.weight(cv::Rect(0, 0, 20, 20)).setTo(400.0F);
  membrane.weight(cv::Rect(180, 180, 20, 20)).setTo(400.0F);
  membrane.target.setTo(0.5F);
  membrane.values.setTo(0.0F);
  cv::Mat without = membrane.values.clone();
  ThreadPool pool(2);
  LineSolver lines;
  CoarseCorrection coarse;
  for (int i = 0; i < 10; ++i)
  {
    lines.solveRows(membrane.grid(), {}, pool);
    lines.solveColumns(membrane.grid(), pool);
    coarse.correct(membrane.grid(), pool);
  }
  const LinkedGrid plain{membrane.weight, membrane.target, membrane.left, membrane.up, without};
  for (int i = 0; i < 40; ++i)
  {
    lines.solveRows(plain, {}, pool);
    lines.solveColumns(plain, pool);
  }
  const cv::Mat expected(membrane.values.size(), CV_32FC1, cv::Scalar(0.5F));
  EXPECT_LT(cv::norm(membrane.values, expected, cv::NORM_INF), 0.05);
  EXPECT_GT(cv::norm(without, expected, cv::NORM_INF), 0.2);
}

TEST(CoarseCorrection, IsTheSameOnAnyNumberOfThreads)
{
  cv::Mat first;
  for (const int threads : {1, 3})
  {
    Membrane membrane({203, 150});
    ThreadPool pool(threads);
    LineSolver lines;
    CoarseCorrection coarse;
    for (int i = 0; i < 2; ++i)
    {
      lines.solveRows(membrane.grid(), {}, pool);
      coarse.correct(membrane.grid(), pool);
    }
    if (threads == 1)
    {
      first = membrane.values.clone();
    }
    EXPECT_EQ(cv::norm(first, membrane.values, cv::NORM_INF), 0.0);
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
