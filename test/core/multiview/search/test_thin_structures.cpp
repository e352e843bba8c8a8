#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/multiview/search/thin_structures.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int SIZE = 40;
constexpr int LINE_X = 20;

/// A bright image with a line of one pixel's width, as bright as asked.
PlanarImage imageWithLine(std::uint8_t line, int channels)
{
  cv::Mat image(SIZE, SIZE, CV_8UC(channels), cv::Scalar::all(200));
  image.col(LINE_X).setTo(cv::Scalar::all(line));
  PlanarImage planar;
  preparePlanar(image, {}, 4, planar);
  return planar;
}

/// The map after the median of a background at 0 with a line at `line_disparity`.
cv::Mat keptMap(const PlanarImage& guide, float line_disparity)
{
  cv::Mat searched = cv::Mat::zeros(SIZE, SIZE, CV_32FC1);
  searched.col(LINE_X).setTo(line_disparity);
  cv::Mat disparity;
  cv::medianBlur(searched, disparity, 5);
  ThreadPool pool(2);
  keepThinStructures(guide, searched, pool, disparity);
  return disparity;
}

TEST(ThinStructures, ALineThatLooksUnlikeItsSurroundingsSurvivesTheMedian)
{
  for (const int channels : {1, 3})
  {
    const cv::Mat kept = keptMap(imageWithLine(40, channels), 1.0F);
    cv::Mat expected = cv::Mat::zeros(SIZE, SIZE, CV_32FC1);
    expected.col(LINE_X).setTo(1.0F);
    EXPECT_EQ(cv::norm(kept, expected, cv::NORM_INF), 0.0) << channels << " channels";
  }
}

TEST(ThinStructures, ALineThatLooksLikeItsSurroundingsIsNoise)
{
  EXPECT_EQ(cv::norm(keptMap(imageWithLine(200, 3), 1.0F), cv::NORM_INF), 0.0);
}

TEST(ThinStructures, NothingMovesAway)
{
  EXPECT_EQ(cv::norm(keptMap(imageWithLine(40, 3), -1.0F), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace light_field_depth::multiview
