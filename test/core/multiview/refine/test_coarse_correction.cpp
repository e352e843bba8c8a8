#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/refine/coarse_correction.h"
#include "core/multiview/refine/coarse_kernels.h"
#include "support/instruction_sets.h"

namespace light_field_depth::multiview
{
namespace
{
const std::vector<int> WIDTHS = {1, 2, 3, 31, 32, 67, 130};

std::vector<float> randomRow(int count, float low, float high)
{
  static std::mt19937 engine(6);
  std::uniform_real_distribution<float> distribution(low, high);
  std::vector<float> row(static_cast<std::size_t>(count));
  std::generate(row.begin(), row.end(), [&] { return distribution(engine); });
  return row;
}

/// Everything that a row of the system reads.
struct Row
{
  explicit Row(int width)
      : weight(randomRow(width, 0.0F, 400.0F)), target(randomRow(width, -3.0F, 3.0F)),
        left(randomRow(width + 1, 0.0F, 200.0F)), up(randomRow(width, 0.0F, 200.0F)),
        down(randomRow(width, 0.0F, 200.0F)), above(randomRow(width, -3.0F, 3.0F)),
        below(randomRow(width, -3.0F, 3.0F)), values(randomRow(width, -3.0F, 3.0F))
  {
    left.front() = left.back() = 0.0F;
  }

  SystemRow row()
  {
    return {weight.data(), target.data(), left.data(),  up.data(),
            down.data(),   above.data(),  below.data(), values.data()};
  }

  std::vector<float> weight, target, left, up, down, above, below, values;
};

struct Sums
{
  explicit Sums(int width) : weight(static_cast<std::size_t>(width)), residual(weight), left(weight) {}
  CellSums pointers() { return {weight.data(), residual.data(), left.data()}; }

  std::vector<float> weight, residual, left;
};

class CoarseKernels : public testing::InstructionSetTest
{
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, CoarseKernels, testing::everyInstructionSet(),
                         testing::instructionSetName);

TEST_P(CoarseKernels, ResidualsEqualThePlainVersion)
{
  for (const int width : WIDTHS)
  {
    Sums simd(width);
    Sums plain(width);
    for (const bool add : {false, true})
    {
      Row row(width);
      sumResiduals(row.row(), width, add, simd.pointers());
      sumResidualsPlain(row.row(), width, add, plain.pointers());
    }
    EXPECT_EQ(simd.weight, plain.weight) << width;
    EXPECT_EQ(simd.residual, plain.residual) << width;
    EXPECT_EQ(simd.left, plain.left) << width;
  }
}

TEST_P(CoarseKernels, JoinedCellsEqualThePlainVersion)
{
  for (const int width : WIDTHS)
  {
    Sums sums(width);
    sums.weight = randomRow(width, 1.0F, 400.0F);
    sums.residual = randomRow(width, -9.0F, 9.0F);
    sums.left = randomRow(width, 0.0F, 200.0F);
    const std::vector<float> up = randomRow(width, 0.0F, 200.0F);
    const auto coarse = static_cast<std::size_t>((width + 1) / 2);
    std::vector<std::vector<float>> results(8, std::vector<float>(coarse + 1, -1.0F));
    joinCells({sums.pointers(), up.data(), width, results[0].data(), results[1].data(), results[2].data(),
               results[3].data()});
    joinCellsPlain({sums.pointers(), up.data(), width, results[4].data(), results[5].data(),
                    results[6].data(), results[7].data()});
    for (std::size_t i = 0; i < 4; ++i)
    {
      EXPECT_EQ(results[i], results[i + 4]) << width;
    }
    EXPECT_EQ(results[2].back(), 0.0F);
    EXPECT_EQ(results[3].back(), -1.0F);
  }
}

TEST_P(CoarseKernels, SpreadRowsEqualThePlainVersion)
{
  for (const int width : WIDTHS)
  {
    const std::vector<float> coarse = randomRow((width + 1) / 2, -1.0F, 1.0F);
    std::vector<float> simd = randomRow(width, -3.0F, 3.0F);
    std::vector<float> plain = simd;
    spreadRow(coarse.data(), 0.7F, width, simd.data());
    spreadRowPlain(coarse.data(), 0.7F, width, plain.data());
    EXPECT_EQ(simd, plain) << width;
  }
}

TEST_P(CoarseKernels, GainsEqualThePlainVersion)
{
  for (const int width : WIDTHS)
  {
    Row row(width);
    std::vector<float> gain = randomRow(width, 0.0F, 9.0F);
    std::vector<float> charge = randomRow(width, 0.0F, 9.0F);
    std::vector<float> plain_gain = gain;
    std::vector<float> plain_charge = charge;
    sumGains(row.row(), width, gain.data(), charge.data());
    sumGainsPlain(row.row(), width, plain_gain.data(), plain_charge.data());
    EXPECT_EQ(gain, plain_gain) << width;
    EXPECT_EQ(charge, plain_charge) << width;
  }
}

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
