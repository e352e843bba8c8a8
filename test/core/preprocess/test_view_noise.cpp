#include "core/preprocess/view_noise.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/noise_estimate.h"

namespace light_field_depth::multiview
{
namespace
{
/// A smooth wall at 1 px with noise that is drawn for each view, blurred by `blur_px`.
LightField noisyWall(double sigma, double blur_px)
{
  cv::RNG random(9);
  cv::Mat wall(200, 260, CV_32FC3);
  for (int y = 0; y < wall.rows; ++y)
  {
    for (int x = 0; x < wall.cols; ++x)
    {
      wall.at<cv::Vec3f>(y, x) =
          cv::Vec3f(90.0F, 120.0F, 150.0F) * (1.0F + 0.001F * static_cast<float>(x + y));
    }
  }
  std::vector<View> views;
  for (int column = -2; column <= 2; ++column)
  {
    cv::Mat noise(wall.rows, wall.cols - 20, CV_32FC3);
    random.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
    if (blur_px > 0.0)
    {
      cv::GaussianBlur(noise, noise, {}, blur_px);
    }
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(noise, mean, deviation);
    const cv::Mat seen = wall.colRange(10 + column, wall.cols - 10 + column) + noise * (sigma / deviation[0]);
    cv::Mat image;
    seen.convertTo(image, CV_8U);
    views.push_back(gridView(0, column + 2, image));
  }
  return makeLightField(views, GridPosition{0, 2});
}

TEST(ViewNoise, IsToldWhateverItsSpectrum)
{
  ThreadPool pool(2);
  for (const double sigma : {1.5, 3.0, 6.0})
  {
    for (const double blur_px : {0.0, 1.2})
    {
      const LightField wall = noisyWall(sigma, blur_px);
      // Less of noise that is wider than a pixel: it moves the mean of a block and the shift that fits best.
      const double tolerance = blur_px > 0.0 ? 0.25 : 0.2;
      EXPECT_NEAR(estimateNoiseOfViews(wall, {-1.0F, 2.0F}, pool), sigma, tolerance * sigma) << blur_px;
      if (blur_px > 0.0)
      {
        EXPECT_LT(estimateNoise(wall.reference().image), 0.5 * sigma);
      }
    }
  }
}

TEST(ViewNoise, SlopesAreMeasuredAboutEachPixel)
{
  constexpr double sigma = 3.0;
  const LightField wall = noisyWall(sigma, 0.0);
  ThreadPool pool(2);
  ViewSet views;
  ViewSetSettings settings;
  settings.range = {-1.0F, 2.0F};
  prepareViews(wall, settings, pool, views);
  ViewNoise noise;
  const cv::Mat disparity(wall.size(), CV_32FC1, cv::Scalar(1.0F));
  measureViewNoise(views, disparity, pool, noise);
  const double of_slopes = 2.0 * (64.0 + 1.0) / 144.0 * sigma * sigma;
  EXPECT_NEAR(noise.value_variance, sigma * sigma, 0.3 * sigma * sigma);
  EXPECT_NEAR(noise.slope_variance, of_slopes, 0.3 * of_slopes);
  EXPECT_EQ(noise.local_slope_variance.size(), wall.size());
  EXPECT_NEAR(noise.local_slope_variance.at<float>(100, 120), of_slopes, 0.3 * of_slopes);
}

/// Plenoptic views may be 0.3 to 0.7 px apart all over the image: the nearest two of each direction then show
/// no block near whole pixels.
TEST(ViewNoise, IsMeasuredInFartherViewsWhereTheNearestDoNotTell)
{
  constexpr double sigma = 3.0;
  constexpr int reach = 4;
  cv::RNG random(11);
  std::vector<View> views;
  for (int row = 0; row <= 2 * reach; ++row)
  {
    for (int column = 0; column <= 2 * reach; ++column)
    {
      if (row == reach || column == reach)
      {
        cv::Mat noise(120, 160, CV_16SC3);
        random.fill(noise, cv::RNG::NORMAL, 0.0, sigma);
        cv::Mat image;
        cv::add(cv::Mat(noise.size(), CV_16SC3, cv::Scalar(90, 120, 150)), noise, image, {}, CV_8U);
        views.push_back(gridView(row, column, image));
      }
    }
  }
  const LightField blank = makeLightField(views, GridPosition{reach, reach});
  ThreadPool pool(2);
  ViewSet prepared;
  ViewSetSettings settings;
  settings.range = {0.0F, 1.0F};
  prepareViews(blank, settings, pool, prepared);
  ViewNoise noise;
  measureViewNoise(prepared, cv::Mat(blank.size(), CV_32FC1, cv::Scalar(0.7F)), pool, noise);
  EXPECT_NEAR(noise.value_variance, sigma * sigma, 0.2 * sigma * sigma);
}

TEST(ViewNoise, IsNoneWhereTooLittleCanBeCompared)
{
  LightField wall = noisyWall(3.0, 0.0);
  for (View& view : wall.views)
  {
    view.image = view.image(cv::Rect(0, 0, 40, 30)).clone();
  }
  ThreadPool pool(1);
  EXPECT_EQ(estimateNoiseOfViews(wall, {-1.0F, 2.0F}, pool), 0.0F);
}

}  // namespace
}  // namespace light_field_depth::multiview
