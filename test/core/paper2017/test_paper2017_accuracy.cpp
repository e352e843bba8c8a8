#include <string>

#include <gtest/gtest.h>

#include "core/paper2017/paper2017_estimator.h"
#include "light_field_depth/evaluation/evaluation.h"
#include "support/benchmark_scenes.h"

namespace light_field_depth
{
namespace
{
Evaluation evaluationOf(const testing::BenchmarkScene& scene, const Paper2017Options& options)
{
  ThreadPool pool(2);
  RunContext context(pool);
  const DisparityEstimate estimate = Paper2017Estimator(options).estimate(scene.light_field, {}, context);
  return evaluate(estimate.disparity, scene.truth);
}

// The bars are what the authors' own release reaches.

TEST(Paper2017Accuracy, Cotton)
{
  const auto scene = testing::readBenchmarkScene("cotton");
  if (!scene)
  {
    GTEST_SKIP() << "cotton is not in " << testing::BENCHMARK_SCENES;
  }
  const Evaluation evaluation = evaluationOf(*scene, {});
  EXPECT_LE(evaluation.mse_100, 1.9);
  EXPECT_LE(evaluation.badpix_007, 32.0);
  // What this implementation adds to that.
  EXPECT_LE(evaluation.mse_100, 1.45);
  EXPECT_LE(evaluation.badpix_007, 4.8);
}

TEST(Paper2017Accuracy, Antinous)
{
  const auto scene = testing::readBenchmarkScene("antinous");
  if (!scene)
  {
    GTEST_SKIP() << "antinous is not in " << testing::BENCHMARK_SCENES;
  }
  const Evaluation evaluation = evaluationOf(*scene, {});
  EXPECT_LE(evaluation.mse_100, 7.0);
  EXPECT_LE(evaluation.badpix_007, 18.6);
  EXPECT_LE(evaluation.mse_100, 6.3);
  EXPECT_LE(evaluation.badpix_007, 9.2);
}

TEST(Paper2017Accuracy, FeatureFlowHelps)
{
  const auto scene = testing::readBenchmarkScene("antinous");
  if (!scene)
  {
    GTEST_SKIP() << "antinous is not in " << testing::BENCHMARK_SCENES;
  }
  Paper2017Options without;
  without.feature_flow.enabled = false;
  EXPECT_LT(evaluationOf(*scene, {}).mse_100, 0.5 * evaluationOf(*scene, without).mse_100);
}

}  // namespace
}  // namespace light_field_depth
