#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/evaluation/sparsification.h"
#include "support/benchmark_scenes.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

/// One row of pixels whose true disparity is 0.
Sparsification sparsifyRow(const std::vector<float>& result, const std::vector<float>& confidence)
{
  const cv::Mat result_row = cv::Mat(result).reshape(1, 1);
  const cv::Mat confidence_row = cv::Mat(confidence).reshape(1, 1);
  return sparsify(result_row, confidence_row, cv::Mat::zeros(result_row.size(), CV_32FC1), {}, 0);
}

TEST(Sparsification, IsIdealWhereTheConfidenceFallsWithTheError)
{
  const Sparsification ideal = sparsifyRow({0.3F, -0.1F, 0.4F, 0.2F}, {0.2F, 0.9F, 0.1F, 0.5F});
  EXPECT_NEAR(ideal.mse_100.ause, 0.0, 1e-12);
  EXPECT_NEAR(ideal.badpix_007.ause, 0.0, 1e-12);
  EXPECT_EQ(ideal.mse_100.error, ideal.mse_100.ideal);
}

TEST(Sparsification, MatchesFiguresThatWereWorkedOutByHand)
{
  // Squares x 100 of 1, 4, 9 and 16, the worst first: 16, 12.5, 29/3 and 7.5 are left; ideal 1, 2.5, 14/3 and
  // 7.5. The differences sum up to 30; 30 / 4 / 7.5 = 1.
  const Sparsification worst = sparsifyRow({0.1F, 0.2F, 0.3F, 0.4F}, {0.0F, 0.1F, 0.2F, 0.3F});
  EXPECT_NEAR(worst.mse_100.ause, 1.0, 1e-6);
  // 100, 100, 200/3 and 50 % of bad pixels are left; ideal 0, 0, 100/3 and 50.
  const Sparsification half_bad = sparsifyRow({0.01F, 0.02F, 0.3F, 0.4F}, {0.0F, 0.1F, 0.2F, 0.3F});
  EXPECT_NEAR(half_bad.badpix_007.ause, (700.0 / 3.0 / 4.0) / 50.0, 1e-9);
}

TEST(Sparsification, TakesTheMeanOverAllOrdersOfEqualConfidences)
{
  // 7.5 is left whatever is dropped; ideal 1, 2.5, 14/3 and 7.5.
  const double expected = (6.5 + 5.0 + 7.5 - 14.0 / 3.0) / 4.0 / 7.5;
  EXPECT_NEAR(sparsifyRow({0.1F, 0.2F, 0.3F, 0.4F}, {1, 1, 1, 1}).mse_100.ause, expected, 1e-6);
  EXPECT_NEAR(sparsifyRow({0.4F, 0.1F, 0.3F, 0.2F}, {1, 1, 1, 1}).mse_100.ause, expected, 1e-6);
}

TEST(Sparsification, SamplesTheCurveInTwentiethsOfThePixels)
{
  std::vector<float> result(40, 0.01F);
  std::vector<float> confidence(40, 0.5F);
  for (const std::size_t bad : {3U, 17U, 22U})
  {
    result[bad] = 1.0F;
    confidence[bad] = bad == 22U ? NaN : 0.1F;
  }
  confidence[5] = 0.1F;
  const Sparsification found = sparsifyRow(result, confidence);
  const std::vector<double>& bad = found.badpix_007.error;
  ASSERT_EQ(bad.size(), static_cast<std::size_t>(SPARSIFICATION_STEPS));
  EXPECT_NEAR(bad[0], 100.0 * 3 / 40, 1e-9);
  EXPECT_NEAR(bad[1], 100.0 * (2.0 - 2.0 / 3.0) / 38, 1e-9) << "NaN goes first, then one of three";
  EXPECT_NEAR(withoutLeastConfidentTenth(found.badpix_007), 0.0, 1e-9);
  EXPECT_NEAR(withoutLeastConfidentTenth(found.mse_100), 0.01, 1e-6);
  EXPECT_NEAR(found.badpix_007.ideal[1], 100.0 / 38, 1e-9);
  EXPECT_NEAR(found.badpix_007.ideal[2], 0.0, 1e-9);
}

TEST(Sparsification, HasNoAreaWhereThereIsNoError)
{
  const Sparsification none = sparsifyRow({0, 0, 0}, {0.1F, 0.2F, 0.3F});
  EXPECT_EQ(none.mse_100.ause, 0.0);
  EXPECT_EQ(none.badpix_007.ause, 0.0);
}

TEST(Sparsification, LeavesOutBorderAndMaskAsTheScoresDo)
{
  cv::Mat result = cv::Mat::ones(6, 7, CV_32FC1);
  result(cv::Rect(1, 1, 5, 4)).setTo(0.0);
  const cv::Mat confidence = cv::Mat::ones(6, 7, CV_32FC1);
  const cv::Mat truth = cv::Mat::zeros(6, 7, CV_32FC1);
  EXPECT_EQ(sparsify(result, confidence, truth, {}, 1).mse_100.error.front(), 0.0);
  cv::Mat mask = cv::Mat::zeros(6, 7, CV_8UC1);
  mask.row(0).setTo(255);
  EXPECT_EQ(sparsify(result, confidence, truth, mask, 0).badpix_007.error.front(), 100.0);
}

TEST(Sparsification, RefusesAConfidenceOfAnotherSize)
{
  const cv::Mat truth = cv::Mat::zeros(6, 7, CV_32FC1);
  const std::string message =
      testing::messageOf<InputError>([&] { sparsify(truth, cv::Mat::zeros(6, 8, CV_32FC1), truth, {}, 0); });
  EXPECT_EQ(message,
            "The confidence has 8 x 6 pixels, the result 7 x 6; give the map that belongs to the result.");
}

/// What the confidence of the default method must achieve on a scene of the HCI benchmark.
struct Bounds
{
  std::string scene;
  double mse_100_without_tenth;
  double badpix_007_without_tenth;
  double ause_mse;
  double ause_badpix_007;
};

class ConfidenceOfMultiview : public ::testing::TestWithParam<Bounds>
{
};

TEST_P(ConfidenceOfMultiview, FindsTheBadPixels)
{
  const Bounds& bounds = GetParam();
  const auto scene = testing::readBenchmarkScene(bounds.scene);
  if (!scene)
  {
    GTEST_SKIP() << bounds.scene << " is not in " << testing::BENCHMARK_SCENES;
  }
  const DisparityEstimate estimate = Pipeline(2).run(scene->light_field, {}, {}).estimate;
  const Sparsification found = sparsify(estimate.disparity, estimate.confidence, scene->truth);
  EXPECT_LT(withoutLeastConfidentTenth(found.mse_100), bounds.mse_100_without_tenth);
  EXPECT_LT(withoutLeastConfidentTenth(found.badpix_007), bounds.badpix_007_without_tenth);
  EXPECT_LT(withoutLeastConfidentTenth(found.badpix_007), 0.5 * found.badpix_007.error.front())
      << "most of the bad pixels are in the least confident tenth";
  EXPECT_LT(found.mse_100.ause, bounds.ause_mse);
  EXPECT_LT(found.badpix_007.ause, bounds.ause_badpix_007);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ConfidenceOfMultiview,
                         ::testing::Values(Bounds{"cotton", 0.04, 0.5, 0.07, 0.22},
                                           Bounds{"antinous", 0.14, 3.5, 0.04, 0.12}),
                         [](const auto& instance) { return instance.param.scene; });

}  // namespace
}  // namespace light_field_depth
