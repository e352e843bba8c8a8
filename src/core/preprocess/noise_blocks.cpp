#include "core/preprocess/noise_blocks.h"

#include <array>
#include <cmath>
#include <cstdlib>

namespace light_field_depth::multiview
{
namespace
{
constexpr int BLOCK = NOISE_BLOCK_PX;
/// Means of so many pixels tell how calm a block is: white noise is low in them.
constexpr int CELL = 4;
constexpr int CELLS = 3;  // in a row over a block and what lies about it
constexpr int MARGIN = (CELLS * CELL - BLOCK) / 2;
constexpr int MIN_BLOCKS = 50;  // fewer do not tell which are the calm ones
/// Between black and white, with room for noise of six levels (two deviations) on both sides.
constexpr int DARKEST_LEVEL = 12;
constexpr int BRIGHTEST_LEVEL = 243;

/// Sets the sum of the changes between neighbouring cells and whether the block is neither black nor white.
void look(const BlockPixels& pixels, NoiseBlock& block)
{
  block.change = 0;
  int level = 0;
  for (int c = 0; c < pixels.channels; ++c)
  {
    std::array<std::array<int, CELLS>, CELLS> cells{};
    for (int y = 0; y < CELLS * CELL; ++y)
    {
      const std::uint8_t* pixel =
          pixels.at(block.x - MARGIN, block.y - MARGIN + y) + c * pixels.channel_stride;
      for (int& cell : cells[static_cast<std::size_t>(y / CELL)])
      {
        for (int x = 0; x < CELL; ++x, pixel += pixels.pixel_stride)
        {
          cell += *pixel;
        }
      }
    }
    for (std::size_t y = 0; y < CELLS; ++y)
    {
      for (std::size_t x = 0; x < CELLS; ++x)
      {
        level += cells[y][x];
        block.change += x > 0 ? std::abs(cells[y][x] - cells[y][x - 1]) : 0;
        block.change += y > 0 ? std::abs(cells[y][x] - cells[y - 1][x]) : 0;
      }
    }
  }
  const int count = pixels.channels * CELLS * CELL * CELLS * CELL;
  block.midtone = level > DARKEST_LEVEL * count && level < BRIGHTEST_LEVEL * count;
}

}  // namespace

BlockPixels pixelsOf(const PlanarImage& image)
{
  const auto channel_stride = static_cast<std::ptrdiff_t>(image.channelStride());
  return {image.row(0),     channel_stride * image.channels(), 1, channel_stride,
          image.channels(), {image.width(), image.height()}};
}

BlockPixels pixelsOf(const cv::Mat& image)
{
  return {image.ptr<std::uint8_t>(), static_cast<std::ptrdiff_t>(image.step[0]),
          image.channels(),          1,
          image.channels(),          image.size()};
}

bool isInside(const BlockPixels& pixels, int x, int y)
{
  return x >= MARGIN && y >= MARGIN && x + BLOCK + MARGIN <= pixels.size.width &&
         y + BLOCK + MARGIN <= pixels.size.height;
}

NoiseBlockGrid::NoiseBlockGrid(const cv::Size& image, int step)
    : step_(step * BLOCK), columns_(count(image.width)), rows_(count(image.height)),
      blocks_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_))
{
  for (int row = 0; row < rows_; ++row)
  {
    for (int column = 0; column < columns_; ++column)
    {
      at(column, row).x = MARGIN + column * step_;
      at(column, row).y = MARGIN + row * step_;
    }
  }
}

int NoiseBlockGrid::count(int side, int step)
{
  return side < BLOCK + 2 * MARGIN ? 0 : (side - BLOCK - 2 * MARGIN) / step + 1;
}

void findChanges(const BlockPixels& pixels, ThreadPool& pool, NoiseBlockGrid& grid)
{
  pool.parallelFor(0, grid.rows(), NOISE_BLOCK_ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int row = first; row < last; ++row)
                     {
                       for (int column = 0; column < grid.columns(); ++column)
                       {
                         look(pixels, grid.at(column, row));
                       }
                     }
                   });
}

int calmLimit(const std::vector<NoiseBlock>& blocks, double part)
{
  std::vector<int> changes;
  for (const NoiseBlock& block : blocks)
  {
    if (block.midtone)
    {
      changes.push_back(block.change);
    }
  }
  if (changes.size() < MIN_BLOCKS)
  {
    return -1;
  }
  const auto limit =
      changes.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(changes.size()));
  std::nth_element(changes.begin(), limit, changes.end());
  return *limit;
}

float medianOfCalm(const std::vector<NoiseBlock>& blocks, int limit, float NoiseBlock::*field)
{
  std::vector<float> values;
  for (const NoiseBlock& block : blocks)
  {
    if (block.midtone && block.change <= limit && block.*field >= 0.0F)
    {
      values.push_back(block.*field);
    }
  }
  return values.empty() ? 0.0F : medianOf(values);
}

float blockVariance(const DifferenceSums& sums, int channels)
{
  constexpr float pixels = BLOCK * BLOCK;
  std::array<int, 3> means{};
  for (int i = 0; i < channels * BLOCK; ++i)
  {
    means[static_cast<std::size_t>(i % channels)] += sums.columns[i];
  }
  auto squares = static_cast<float>(sums.squares);
  for (const int sum : means)
  {
    squares -= static_cast<float>(sum) * static_cast<float>(sum) / pixels;
  }
  return squares / (pixels * static_cast<float>(channels));
}

}  // namespace light_field_depth::multiview
