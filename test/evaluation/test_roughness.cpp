#include "light_field_depth/evaluation/roughness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
const cv::Size SIZE(160, 120);

/// Noise in the right half, nothing in the left.
cv::Mat halfFlatImage()
{
  cv::Mat image(SIZE, CV_8UC3, cv::Scalar::all(128));
  cv::RNG random(3);
  random.fill(image.colRange(80, 160), cv::RNG::UNIFORM, 0, 255);
  return image;
}

cv::Mat slantedMap()
{
  cv::Mat map(SIZE, CV_32FC1);
  for (int y = 0; y < map.rows; ++y)
  {
    for (int x = 0; x < map.cols; ++x)
    {
      map.at<float>(y, x) = 0.01F * static_cast<float>(x) - 0.02F * static_cast<float>(y);
    }
  }
  return map;
}

void addNoise(double sigma, cv::Mat map)
{
  cv::Mat noise(map.size(), CV_32FC1);
  cv::RNG random(4);
  random.fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  map += noise;
}

TEST(Roughness, IsTheNoiseOfTheMapWhereTheImageIsFlat)
{
  cv::Mat map = slantedMap();
  EXPECT_LT(roughness(map, halfFlatImage()), 0.01);  // what the border does to the Gaussian of a slope
  addNoise(0.1, map.colRange(0, 80));
  EXPECT_NEAR(roughness(map, halfFlatImage()), 0.1, 0.005);
}

TEST(Roughness, DoesNotSeeWhatTheImageHasTextureFor)
{
  cv::Mat map = slantedMap();
  addNoise(0.5, map.colRange(100, 160));
  EXPECT_LT(roughness(map, halfFlatImage()), 0.01);
}

TEST(Roughness, LeavesOutWhatIsUnknown)
{
  cv::Mat map = slantedMap();
  addNoise(0.1, map);
  const double expected = roughness(map, halfFlatImage());
  for (int y = 30; y < 40; ++y)
  {
    map.at<float>(y, 30) = std::numeric_limits<float>::quiet_NaN();
    map.at<float>(y, 31) = std::numeric_limits<float>::infinity();
  }
  EXPECT_NEAR(roughness(map, halfFlatImage()), expected, 0.002);
  map.setTo(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(roughness(map, halfFlatImage()), 0.0);
}

TEST(Roughness, RefusesWhatDoesNotFit)
{
  EXPECT_THROW(roughness(cv::Mat(60, 60, CV_32FC1), halfFlatImage()), InputError);
  EXPECT_THROW(roughness(cv::Mat(SIZE, CV_8UC1), halfFlatImage()), InputError);
  EXPECT_THROW(roughness(cv::Mat(24, 24, CV_32FC1), cv::Mat(24, 24, CV_8UC1)), InputError);
}

}  // namespace
}  // namespace light_field_depth
