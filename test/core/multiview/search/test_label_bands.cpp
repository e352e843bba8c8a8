#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/search/label_bands.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr LabelSpace LABELS{-2.0F, 0.25F, 33};  // -2 .. 6

TEST(LabelBands, CoverAllLabelsInTilesThatMayStandOut)
{
  LabelBands bands;
  bands.setAll(65, 32, 7);
  EXPECT_EQ(bands.columns(), 3);
  EXPECT_EQ(bands.rows(), 1);
  EXPECT_EQ(bands.at(0, 2).first, 0);
  EXPECT_EQ(bands.at(0, 2).end(), 7);
}

TEST(LabelBands, HoldWhatTheTileAndItsSurroundingsHave)
{
  cv::Mat disparity(64, 96, CV_32FC1, 1.0F);
  disparity.at<float>(10, 40) = 2.1F;  // 8 pixels right of the first tile
  ThreadPool pool(2);
  LabelBands bands;
  bands.setAround(disparity, LABELS, 9, 2.0F, pool);
  EXPECT_EQ(bands.at(0, 0).first, 10);  // label 12 of 1.0, and two less
  EXPECT_EQ(bands.at(0, 0).end(), 20);  // label 16.4 of 2.1, and two more
  EXPECT_EQ(bands.at(1, 2).first, 10);
  EXPECT_EQ(bands.at(1, 2).end(), 15);
  bands.setAround(disparity, LABELS, 8, 2.0F, pool);
  EXPECT_EQ(bands.at(0, 0).end(), 15);
}

TEST(LabelBands, StayInsideTheLabels)
{
  const cv::Mat disparity(32, 32, CV_32FC1, 50.0F);
  ThreadPool pool(1);
  LabelBands bands;
  bands.setAround(disparity, LABELS, 0, 4.0F, pool);
  EXPECT_EQ(bands.at(0, 0).first, 32);
  EXPECT_EQ(bands.at(0, 0).count, 1);
}

}  // namespace
}  // namespace light_field_depth::multiview
