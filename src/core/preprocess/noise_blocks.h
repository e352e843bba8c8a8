#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_NOISE_BLOCKS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_NOISE_BLOCKS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/light_field/view_set.h"
#include "core/preprocess/view_noise_kernels.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Rows of blocks that are worked on by one thread at a time.
constexpr int NOISE_BLOCK_ROWS_PER_CHUNK = 4;

/// Pixels of an image, whether its channels lie in planes or beside each other.
struct BlockPixels
{
  const std::uint8_t* origin;
  std::ptrdiff_t row_stride;
  std::ptrdiff_t pixel_stride;
  std::ptrdiff_t channel_stride;
  int channels;
  cv::Size size;

  const std::uint8_t* at(int x, int y) const { return origin + y * row_stride + x * pixel_stride; }
};

BlockPixels pixelsOf(const PlanarImage& image);
BlockPixels pixelsOf(const cv::Mat& image);  ///< of a CV_8U image with any number of channels

/// Whether a block whose first pixel is (x, y) lies in the image with all that is read about it.
bool isInside(const BlockPixels& pixels, int x, int y);

/// A square of NOISE_BLOCK_PX pixels of the reference view.
struct NoiseBlock
{
  int x = 0;
  int y = 0;
  int change = 0;        ///< between the means of neighbouring cells
  bool midtone = false;  ///< neither nearly black nor nearly white
  float value = -1.0F;   ///< variance; below 0: unknown
  float slope = -1.0F;
};

/// Blocks in rows and columns, each with the pixels about it that findChanges() reads.
class NoiseBlockGrid
{
public:
  /// @param step blocks from one to the next; 1: they touch
  NoiseBlockGrid(const cv::Size& image, int step);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  NoiseBlock& at(int column, int row)
  {
    return blocks_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(column)];
  }
  std::vector<NoiseBlock>& blocks() { return blocks_; }

  /// @return how many blocks lie along a side of the image
  /// @param step in pixels
  static int count(int side, int step);

private:
  int count(int side) const { return count(side, step_); }

  int step_;
  int columns_;
  int rows_;
  std::vector<NoiseBlock> blocks_;
};

/// Sets of every block how calm it is and whether it is neither black nor white.
void findChanges(const BlockPixels& pixels, ThreadPool& pool, NoiseBlockGrid& grid);

/// @return the change that a part of the midtone blocks does not exceed; negative if there are too few blocks
int calmLimit(const std::vector<NoiseBlock>& blocks, double part);

/// Median of what the blocks that are calm enough know; 0 if none does.
/// @param limit on their change
float medianOfCalm(const std::vector<NoiseBlock>& blocks, int limit, float NoiseBlock::*field);

/// Variance within the block of the difference to a block of another view, a channel.
float blockVariance(const DifferenceSums& sums, int channels);

/// The upper one of the two in the middle. Orders the values anew; there must be one.
template <typename Value>
Value medianOf(std::vector<Value>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_NOISE_BLOCKS_H
