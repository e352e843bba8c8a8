#include "core/multiview/maps/confidence.h"

#include <gtest/gtest.h>

namespace light_field_depth::multiview
{
namespace
{
const cv::Size SIZE(61, 70);

/// Everything speaks for the map.
struct GoodEvidence
{
  cv::Mat disparity{SIZE, CV_32FC1, cv::Scalar(0.5)};
  cv::Mat searched = disparity.clone();
  cv::Mat first_search = disparity.clone();
  Linearization linear;

  GoodEvidence()
  {
    linear.weight = cv::Mat(SIZE, CV_32FC1, cv::Scalar(100.0));
    linear.target = disparity.clone();
    linear.residual = cv::Mat(SIZE, CV_32FC1, cv::Scalar(3.0));
    linear.disagreement = cv::Mat(SIZE, CV_32FC1, cv::Scalar(0.0));
  }

  cv::Mat confidence(int threads = 2) const
  {
    ThreadPool pool(threads);
    cv::Mat result;
    estimateConfidence({disparity, searched, first_search, linear, 0.0F}, pool, result);
    return result;
  }
};

TEST(Confidence, IsHighWhereEverythingAgrees)
{
  const cv::Mat confidence = GoodEvidence().confidence();
  EXPECT_GT(confidence.at<float>(30, 30), 0.98F);
  EXPECT_EQ(confidence.at<float>(0, 0), confidence.at<float>(30, 30)) << "borders are nothing special";
}

TEST(Confidence, FallsWithinTwoPixelsOfADepthEdge)
{
  GoodEvidence evidence;
  evidence.disparity.colRange(31, 61).setTo(2.0);
  evidence.searched = evidence.disparity;
  evidence.first_search = evidence.disparity;
  evidence.linear.target = evidence.disparity;
  const cv::Mat confidence = evidence.confidence();
  EXPECT_LT(confidence.at<float>(30, 30), 0.2F);
  EXPECT_LT(confidence.at<float>(30, 31), 0.2F);
  EXPECT_LT(confidence.at<float>(30, 29), confidence.at<float>(30, 28));
  EXPECT_GT(confidence.at<float>(30, 28), 0.98F);
}

TEST(Confidence, FallsWithEachPieceOfEvidenceAndStaysAProbability)
{
  const auto with = [](cv::Mat& (*map)(GoodEvidence&), double value)
  {
    GoodEvidence evidence;
    map(evidence).at<float>(30, 30) = static_cast<float>(value);
    const float confidence = evidence.confidence().at<float>(30, 30);
    EXPECT_GE(confidence, 0.0F);
    EXPECT_LE(confidence, 1.0F);
    return confidence;
  };
  const float good = GoodEvidence().confidence().at<float>(30, 30);
  EXPECT_LT(with([](GoodEvidence& e) -> cv::Mat& { return e.linear.weight; }, 0.0), good);
  EXPECT_LT(with([](GoodEvidence& e) -> cv::Mat& { return e.linear.disagreement; }, 0.2), good);
  EXPECT_LT(with([](GoodEvidence& e) -> cv::Mat& { return e.linear.residual; }, 100.0), good);
  EXPECT_LT(with([](GoodEvidence& e) -> cv::Mat& { return e.linear.target; }, 0.6), good);
  EXPECT_LT(with([](GoodEvidence& e) -> cv::Mat& { return e.searched; }, 0.7), good);
  EXPECT_LT(with([](GoodEvidence& e) -> cv::Mat& { return e.first_search; }, 0.7), good);
  EXPECT_LT(with([](GoodEvidence& e) -> cv::Mat& { return e.linear.weight; }, 1.0),
            with([](GoodEvidence& e) -> cv::Mat& { return e.linear.weight; }, 10.0));
}

TEST(Confidence, IsTheSameOnAnyNumberOfThreads)
{
  GoodEvidence evidence;
  cv::RNG random(4);
  random.fill(evidence.disparity, cv::RNG::UNIFORM, 0.0, 1.0);
  EXPECT_EQ(cv::norm(evidence.confidence(1), evidence.confidence(3), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace light_field_depth::multiview
