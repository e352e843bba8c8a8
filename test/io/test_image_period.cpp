#include "io/image_period.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "io/scene_folders.h"

namespace light_field_depth
{
namespace
{
using testing::RenderedScene;

cv::Mat tiled(int columns, int rows)
{
  const cv::Size size = RenderedScene::view(0, 0).size();
  cv::Mat image(size.height * rows, size.width * columns, CV_8UC3);
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      RenderedScene::view(row, column)
          .copyTo(image(cv::Rect({column * size.width, row * size.height}, size)));
    }
  }
  return image;
}

TEST(ImagePeriod, FindsTheTilesOfATable)
{
  EXPECT_EQ(findTiles(tiled(5, 5)), cv::Size(5, 5));
  EXPECT_EQ(findTiles(tiled(4, 1)), cv::Size(4, 1));
  EXPECT_EQ(findTiles(tiled(2, 3)), cv::Size(2, 3));
}

TEST(ImagePeriod, FindsTheLensletsOfAPlenopticImage)
{
  EXPECT_EQ(findLenslets(testing::lenslets(RenderedScene::view)), cv::Size(5, 5));
}

TEST(ImagePeriod, AnOrdinaryImageHasNone)
{
  EXPECT_FALSE(findTiles(RenderedScene::view(2, 4)));
  cv::Mat large;
  cv::resize(RenderedScene::view(2, 4), large, {640, 480}, 0, 0, cv::INTER_CUBIC);
  EXPECT_FALSE(findTiles(large));
  EXPECT_FALSE(findLenslets(large));
  const cv::Mat flat(480, 640, CV_8UC1, cv::Scalar(90));
  EXPECT_FALSE(findTiles(flat));
  EXPECT_FALSE(findLenslets(flat));
}

TEST(ImagePeriod, PartsAreTheViews)
{
  const cv::Mat tiles = tiled(4, 1);
  const ViewPart tile = {ViewPart::Kind::Tile, {4, 1}, {0, 2}};
  EXPECT_EQ(cv::norm(extractPart(tiles, tile), RenderedScene::view(0, 2), cv::NORM_INF), 0.0);
  const cv::Mat lenslets = testing::lenslets(RenderedScene::view);
  const ViewPart pixel = {ViewPart::Kind::Lenslet, {5, 5}, {3, 1}};
  EXPECT_EQ(cv::norm(extractPart(lenslets, pixel), RenderedScene::view(3, 1), cv::NORM_INF), 0.0);
  EXPECT_EQ(extractPart(tiles, {}).data, tiles.data);
}

}  // namespace
}  // namespace light_field_depth
