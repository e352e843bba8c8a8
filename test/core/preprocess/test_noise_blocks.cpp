#include "core/preprocess/noise_blocks.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace light_field_depth::multiview
{
namespace
{
TEST(NoiseBlocks, BlocksKeepTwoPixelsAboutThem)
{
  EXPECT_EQ(NoiseBlockGrid::count(11, NOISE_BLOCK_PX), 0);
  EXPECT_EQ(NoiseBlockGrid::count(12, NOISE_BLOCK_PX), 1);
  EXPECT_EQ(NoiseBlockGrid::count(19, NOISE_BLOCK_PX), 1);
  EXPECT_EQ(NoiseBlockGrid::count(20, NOISE_BLOCK_PX), 2);
  NoiseBlockGrid grid({44, 20}, 2);
  EXPECT_EQ(grid.columns(), 3);
  EXPECT_EQ(grid.rows(), 1);
  EXPECT_EQ(grid.at(2, 0).x, 34);
  EXPECT_EQ(grid.at(2, 0).y, 2);
  const cv::Mat image(20, 44, CV_8UC1, cv::Scalar(0));
  EXPECT_TRUE(isInside(pixelsOf(image), 34, 2));
  EXPECT_FALSE(isInside(pixelsOf(image), 35, 2));
  EXPECT_FALSE(isInside(pixelsOf(image), 34, 1));
}

TEST(NoiseBlocks, ChangesAreThoseBetweenSumsOfFourByFourPixels)
{
  // Three cells in a row and three rows of them; the middle column is brighter by 10.
  cv::Mat image(12, 12, CV_8UC1, cv::Scalar(100));
  image.colRange(4, 8).setTo(110);
  NoiseBlockGrid grid(image.size(), 1);
  ThreadPool pool(1);
  findChanges(pixelsOf(image), pool, grid);
  EXPECT_EQ(grid.at(0, 0).change, 3 * 2 * 10 * 16);
  EXPECT_TRUE(grid.at(0, 0).midtone);
  image.setTo(12);
  findChanges(pixelsOf(image), pool, grid);
  EXPECT_EQ(grid.at(0, 0).change, 0);
  EXPECT_FALSE(grid.at(0, 0).midtone);
  image.setTo(243);
  findChanges(pixelsOf(image), pool, grid);
  EXPECT_FALSE(grid.at(0, 0).midtone);
}

TEST(NoiseBlocks, ColourInPlanesAndBesideEachOtherIsTheSame)
{
  cv::Mat colour(28, 36, CV_8UC3);
  cv::RNG random(2);
  random.fill(colour, cv::RNG::UNIFORM, 60, 180);
  PlanarImage planes;
  planes.create(colour.cols, colour.rows, 3, 8);
  for (int y = 0; y < colour.rows; ++y)
  {
    for (int x = 0; x < colour.cols; ++x)
    {
      for (int channel = 0; channel < 3; ++channel)
      {
        planes.row(
            y)[static_cast<std::size_t>(channel) * planes.channelStride() + static_cast<std::size_t>(x)] =
            colour.at<cv::Vec3b>(y, x)[channel];
      }
    }
  }
  ThreadPool pool(2);
  NoiseBlockGrid beside(colour.size(), 1);
  NoiseBlockGrid in_planes(colour.size(), 1);
  findChanges(pixelsOf(colour), pool, beside);
  findChanges(pixelsOf(planes), pool, in_planes);
  ASSERT_EQ(beside.blocks().size(), 12U);
  for (std::size_t i = 0; i < beside.blocks().size(); ++i)
  {
    EXPECT_GT(beside.blocks()[i].change, 0);
    EXPECT_EQ(beside.blocks()[i].change, in_planes.blocks()[i].change);
  }
}

std::vector<NoiseBlock> blocksWithChanges(int count)
{
  std::vector<NoiseBlock> blocks(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
  {
    NoiseBlock& block = blocks[static_cast<std::size_t>(i)];
    block.change = (37 * i) % count;  // every number below count, in another order
    block.midtone = true;
    block.value = static_cast<float>(block.change);
  }
  return blocks;
}

TEST(NoiseBlocks, TheCalmestPartOfTheMidtonesIsAskedIfThereAreFifty)
{
  std::vector<NoiseBlock> blocks = blocksWithChanges(101);
  EXPECT_EQ(calmLimit(blocks, 0.2), 20);
  EXPECT_FLOAT_EQ(medianOfCalm(blocks, 20, &NoiseBlock::value), 10.0F);
  EXPECT_FLOAT_EQ(medianOfCalm(blocks, 20, &NoiseBlock::slope), 0.0F) << "no block knows its slope";
  for (std::size_t i = 0; i < 52; ++i)
  {
    blocks[i].midtone = false;
  }
  EXPECT_EQ(calmLimit(blocks, 0.2), -1);
}

TEST(NoiseBlocks, VarianceIsThatAboutTheMeanOfEachChannel)
{
  // Differences of 3 in one channel and of 5 in the other, with a square wave of 2 on the first.
  DifferenceSums sums;
  for (int i = 0; i < 2 * NOISE_BLOCK_PX; ++i)
  {
    sums.columns[i] = NOISE_BLOCK_PX * (i % 2 == 0 ? 3 : 5);
  }
  const int pixels = NOISE_BLOCK_PX * NOISE_BLOCK_PX;
  sums.squares = pixels / 2 * (1 * 1 + 5 * 5) + pixels * 5 * 5;
  EXPECT_FLOAT_EQ(blockVariance(sums, 2), 2.0F) << "4 in one channel and 0 in the other";
}

TEST(NoiseBlocks, TheMedianOfAnEvenNumberIsTheUpperOne)
{
  std::vector<int> values = {7, 1, 5, 3};
  EXPECT_EQ(medianOf(values), 5);
}

}  // namespace
}  // namespace light_field_depth::multiview
