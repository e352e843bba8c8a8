#include "light_field_depth/core/noise_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "light_field_depth/core/error.h"
#include "support/benchmark_scenes.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
cv::Mat withNoise(const cv::Mat& image, double sigma)
{
  cv::RNG random(7);
  cv::Mat noise(image.size(), CV_MAKETYPE(CV_32F, image.channels()));
  random.fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  cv::Mat values;
  image.convertTo(values, CV_32F);
  values += noise;
  cv::Mat bytes;
  values.convertTo(bytes, CV_8U);
  return bytes;
}

void expectEstimates(const cv::Mat& image)
{
  const double own = estimateNoise(image);
  for (const double sigma : {1.0, 2.0, 3.0, 5.0, 8.0, 10.0})
  {
    const double expected = std::hypot(sigma, own);
    EXPECT_NEAR(estimateNoise(withNoise(image, sigma)), expected, 0.2 * expected) << "sigma " << sigma;
  }
}

TEST(NoiseEstimate, IsNearZeroForCleanImages)
{
  EXPECT_EQ(estimateNoise(cv::Mat(64, 64, CV_8UC3, cv::Scalar(90, 100, 110))), 0.0F);
  testing::SceneSettings settings;
  settings.positions = testing::gridPositions(1, 2);
  const auto scene = renderScene(testing::standardScene(settings.size), settings);
  EXPECT_LT(estimateNoise(scene.light_field.reference().image), 0.8F);
}

TEST(NoiseEstimate, MeasuresNoiseInSpiteOfTexture)
{
  testing::SceneSettings settings;
  settings.size = {256, 192};
  settings.positions = testing::gridPositions(1, 2);
  settings.samples = 2;
  const auto scene = renderScene(testing::standardScene(settings.size), settings);
  expectEstimates(scene.light_field.reference().image);
}

TEST(NoiseEstimate, TakesGreyImagesAndTheSmallest)
{
  const cv::Mat flat(128, 128, CV_8UC1, cv::Scalar(128));
  EXPECT_NEAR(estimateNoise(withNoise(flat, 4.0)), 4.0, 0.4);
  const cv::Mat smallest = flat(cv::Rect(0, 0, 16, 16));
  EXPECT_NEAR(estimateNoise(withNoise(smallest, 4.0)), 4.0, 1.5);
}

TEST(NoiseEstimate, RejectsWhatItCannotMeasure)
{
  EXPECT_THROW(estimateNoise(cv::Mat(64, 64, CV_16UC1, cv::Scalar(0))), InputError);
  EXPECT_THROW(estimateNoise(cv::Mat(8, 64, CV_8UC1, cv::Scalar(0))), InputError);
}

TEST(NoiseEstimate, MeasuresNoiseAddedToTheBenchmarkScenes)
{
  for (const std::string name : {"cotton", "antinous"})
  {
    const auto scene = testing::readBenchmarkScene(name);
    if (!scene)
    {
      GTEST_SKIP() << name << " is not in " << testing::BENCHMARK_SCENES;
    }
    SCOPED_TRACE(name);
    const cv::Mat image = scene->light_field.reference().image;
    EXPECT_LT(estimateNoise(image), 1.0F);
    expectEstimates(image);
  }
}

}  // namespace
}  // namespace light_field_depth
