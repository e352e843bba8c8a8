#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "light_field_depth/core/error.h"
#include "light_field_depth/evaluation/photometric_error.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
testing::SyntheticLightField scene()
{
  testing::SceneSettings settings;
  settings.positions = testing::crossPositions(5, 5);
  return testing::renderScene(testing::standardScene(settings.size), settings);
}

TEST(PhotometricError, IsLeastForTheTruth)
{
  const auto input = scene();
  ThreadPool pool(2);
  const double at_truth = photometricError(input.light_field, input.truth, pool).mean_of_medians;
  EXPECT_LT(at_truth, 1.5);
  for (const float offset : {-0.2F, 0.2F})
  {
    const cv::Mat moved = input.truth + offset;
    EXPECT_GT(photometricError(input.light_field, moved, pool).mean_of_medians, 2.0 * at_truth);
  }
}

TEST(PhotometricError, LeavesOutWhatIsUnknownAndWhatNoViewSees)
{
  const auto input = scene();
  cv::Mat disparity = input.truth.clone();
  disparity.at<float>(40, 40) = std::numeric_limits<float>::quiet_NaN();
  disparity.at<float>(41, 41) = 1000.0F;
  ThreadPool pool(1);
  const PhotometricError error = photometricError(input.light_field, disparity, pool);
  EXPECT_TRUE(std::isnan(error.medians.at<float>(40, 40)));
  EXPECT_TRUE(std::isnan(error.medians.at<float>(41, 41)));
  EXPECT_FALSE(std::isnan(error.medians.at<float>(42, 42)));
  EXPECT_TRUE(std::isfinite(error.mean));
}

TEST(PhotometricError, IsNearlyTheSameOfAPartOfThePixels)
{
  const auto input = scene();
  ThreadPool pool(2);
  const PhotometricError all = photometricError(input.light_field, input.truth, pool);
  const auto pixels = static_cast<int>(input.truth.total());
  const std::size_t samples = input.truth.total() * (input.light_field.views.size() - 1);
  for (const int part : {2, 3, 5})
  {
    const PhotometricError some =
        photometricError(input.light_field, input.truth, pool, samples / static_cast<std::size_t>(part));
    const int taken = cv::countNonZero(some.medians == some.medians);
    EXPECT_LE(taken, pixels / part + input.truth.rows);
    EXPECT_GT(taken, pixels / part - pixels / 20);
    EXPECT_NEAR(some.mean, all.mean, 0.03 * all.mean) << "every pixel of " << part;
    EXPECT_NEAR(some.mean_of_medians, all.mean_of_medians, 0.03 * all.mean_of_medians);
  }
}

TEST(PhotometricError, DoesNotDependOnTheNumberOfThreads)
{
  const auto input = scene();
  ThreadPool one(1);
  ThreadPool three(3);
  EXPECT_EQ(photometricError(input.light_field, input.truth, one).mean,
            photometricError(input.light_field, input.truth, three).mean);
}

TEST(PhotometricError, RefusesAMapOfAnotherSize)
{
  const auto input = scene();
  ThreadPool pool(1);
  EXPECT_THROW(photometricError(input.light_field, cv::Mat(10, 10, CV_32FC1), pool), InputError);
}

}  // namespace
}  // namespace light_field_depth
