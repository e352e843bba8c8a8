#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "light_field_depth/core/paper2017_estimator.h"
#include "light_field_depth/io/dataset.h"
#include "light_field_depth/io/evaluation.h"
#include "light_field_depth/io/pfm.h"

namespace light_field_depth
{
namespace
{
const std::filesystem::path HCI = "../shared/data/hci";

Evaluation evaluationOf(const std::string& scene, const Paper2017Options& options)
{
  const Dataset dataset = readDataset(HCI / scene);
  ThreadPool pool(2);
  RunContext context(pool);
  const DisparityEstimate estimate = Paper2017Estimator(options).estimate(dataset.light_field, {}, context);
  return evaluate(estimate.disparity, readPfm(dataset.truth.value()));
}

// The bars are what the authors' own release reaches.

TEST(Paper2017Accuracy, Cotton)
{
  if (!std::filesystem::exists(HCI / "cotton"))
  {
    GTEST_SKIP() << "The scene cotton of the HCI benchmark is not at " << HCI;
  }
  const Evaluation evaluation = evaluationOf("cotton", {});
  EXPECT_LE(evaluation.mse_100, 1.9);
  EXPECT_LE(evaluation.badpix_007, 32.0);
  // What this implementation adds to that.
  EXPECT_LE(evaluation.mse_100, 1.45);
  EXPECT_LE(evaluation.badpix_007, 4.8);
}

TEST(Paper2017Accuracy, Antinous)
{
  if (!std::filesystem::exists(HCI / "antinous"))
  {
    GTEST_SKIP() << "The scene antinous of the HCI benchmark is not at " << HCI;
  }
  const Evaluation evaluation = evaluationOf("antinous", {});
  EXPECT_LE(evaluation.mse_100, 7.0);
  EXPECT_LE(evaluation.badpix_007, 18.6);
  EXPECT_LE(evaluation.mse_100, 6.3);
  EXPECT_LE(evaluation.badpix_007, 9.2);
}

TEST(Paper2017Accuracy, FeatureFlowHelps)
{
  if (!std::filesystem::exists(HCI / "antinous"))
  {
    GTEST_SKIP() << "The scene antinous of the HCI benchmark is not at " << HCI;
  }
  Paper2017Options without;
  without.feature_flow.enabled = false;
  EXPECT_LT(evaluationOf("antinous", {}).mse_100, 0.5 * evaluationOf("antinous", without).mse_100);
}

}  // namespace
}  // namespace light_field_depth
