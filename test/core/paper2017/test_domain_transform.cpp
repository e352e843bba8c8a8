#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/paper2017/domain_transform.h"

namespace light_field_depth
{
namespace
{
WeightedValues impulse(const cv::Size& size, const cv::Point& at)
{
  WeightedValues values{cv::Mat::zeros(size, CV_32FC1), cv::Mat::zeros(size, CV_32FC1)};
  values.weighted.at<float>(at) = 3.0F;
  values.weight.at<float>(at) = 1.0F;
  return values;
}

/// A one-dimensional pass there and back, written out as a matrix: element (i, j) is what output i takes of
/// input j.
cv::Mat passMatrix(const std::vector<double>& feedback)
{
  const int n = static_cast<int>(feedback.size());
  cv::Mat there = cv::Mat::zeros(n, n, CV_64F);
  cv::Mat back = cv::Mat::zeros(n, n, CV_64F);
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      double product = j > 0 ? 1.0 - feedback[static_cast<std::size_t>(j)] : 1.0;
      for (int k = j + 1; k <= i; ++k)
      {
        product *= feedback[static_cast<std::size_t>(k)];
      }
      there.at<double>(i, j) = product;
    }
    for (int j = i; j < n; ++j)
    {
      double product = j < n - 1 ? 1.0 - feedback[static_cast<std::size_t>(j) + 1] : 1.0;
      for (int k = i; k < j; ++k)
      {
        product *= feedback[static_cast<std::size_t>(k) + 1];
      }
      back.at<double>(i, j) = product;
    }
  }
  return back * there;
}

TEST(DomainTransform, FeedbackFollowsTheFormula)
{
  const DomainTransformScale scale{60.0, 0.4};
  const FeedbackTable first(scale, 0, 3, 3);
  const double deviation = 60.0 * std::sqrt(3.0) * 4.0 / std::sqrt(63.0);
  EXPECT_NEAR(first[0], std::exp(-std::sqrt(2.0) / deviation), 1e-6);
  EXPECT_NEAR(first[51], std::exp(-std::sqrt(2.0) / deviation * (1.0 + 60.0 / 0.4 * 0.2)), 1e-6);
  const FeedbackTable second(scale, 1, 3, 3);
  EXPECT_NEAR(second[20], first[20] * first[20], 1e-6);
  const FeedbackTable grey(scale, 0, 3, 1);
  EXPECT_FLOAT_EQ(grey[10], first[30]);
}

TEST(DomainTransform, EqualsTheDirectProductOfItsPasses)
{
  cv::Mat guide(9, 13, CV_8UC3);
  cv::RNG random(7);
  random.fill(guide, cv::RNG::UNIFORM, 0, 30);
  const FeedbackTable table({8.0, 0.3}, 0, 2, 3);
  WeightedValues values{cv::Mat(guide.size(), CV_32FC1), cv::Mat(guide.size(), CV_32FC1)};
  random.fill(values.weighted, cv::RNG::UNIFORM, -1.0, 1.0);
  random.fill(values.weight, cv::RNG::UNIFORM, 0.0, 1.0);
  cv::Mat expected;
  values.weighted.convertTo(expected, CV_64F);
  const auto difference = [&](int y, int x, int dy, int dx)
  {
    return static_cast<int>(
        cv::norm(guide.at<cv::Vec3b>(y, x), guide.at<cv::Vec3b>(y - dy, x - dx), cv::NORM_L1));
  };
  for (int y = 0; y < guide.rows; ++y)
  {
    std::vector<double> feedback(static_cast<std::size_t>(guide.cols));
    for (int x = 1; x < guide.cols; ++x)
    {
      feedback[static_cast<std::size_t>(x)] = table[difference(y, x, 0, 1)];
    }
    const cv::Mat row = passMatrix(feedback) * expected.row(y).t();
    cv::Mat(row.t()).copyTo(expected.row(y));
  }
  for (int x = 0; x < guide.cols; ++x)
  {
    std::vector<double> feedback(static_cast<std::size_t>(guide.rows));
    for (int y = 1; y < guide.rows; ++y)
    {
      feedback[static_cast<std::size_t>(y)] = table[difference(y, x, 1, 0)];
    }
    cv::Mat(passMatrix(feedback) * expected.col(x)).copyTo(expected.col(x));
  }
  filterSpatially(guide, table, values);
  cv::Mat result;
  values.weighted.convertTo(result, CV_64F);
  EXPECT_LT(cv::norm(result, expected, cv::NORM_INF), 1e-5);
}

TEST(DomainTransform, KeepsTheRatioOfAConstantAndItsTotal)
{
  const cv::Mat guide(20, 30, CV_8UC1, cv::Scalar(80));
  WeightedValues values = impulse(guide.size(), {12, 9});
  filterSpatially(guide, FeedbackTable({10.0, 0.1}, 0, 1, 1), values);
  EXPECT_LT(cv::norm(values.weighted, values.weight * 3.0, cv::NORM_INF), 1e-6);
  EXPECT_GT(values.weight.at<float>(9, 13), values.weight.at<float>(9, 20));
  EXPECT_GT(values.weight.at<float>(19, 29), 0.0F);
}

TEST(DomainTransform, StopsAtEdges)
{
  cv::Mat guide(20, 30, CV_8UC3, cv::Scalar(40, 40, 40));
  guide.colRange(15, 30).setTo(cv::Scalar(140, 140, 140));
  WeightedValues values = impulse(guide.size(), {12, 9});
  filterSpatially(guide, FeedbackTable({2000.0, 0.1}, 0, 1, 3), values);
  EXPECT_LT(values.weight.at<float>(9, 16), 1e-3F * values.weight.at<float>(9, 13));
}

}  // namespace
}  // namespace light_field_depth
