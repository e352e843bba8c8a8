#include "core/preprocess/view_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/preprocess/noise_blocks.h"
#include "core/preprocess/view_noise_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int BLOCK = NOISE_BLOCK_PX;
/// The nearest views that are compared, set by hand; the time grows with them. One alone cannot tell noise
/// from texture.
constexpr std::size_t VIEWS_COMPARED = 8;
constexpr std::size_t MIN_VIEWS_COMPARED = 2;
/// Blocks are compared at whole pixels. Where the shift is farther from one, texture makes a difference that
/// is no noise. With this limit four in ten views are left, and a sixth of the variance of that difference.
constexpr double MAX_ROUNDED_PX = 0.2;
/// Least lower quartile of the variances of one block over their median where they are noise: even noise as
/// soft as a Gaussian of 1.2 px, of which a block has twenty independent samples, has 0.8.
constexpr float MIN_ALIKE = 0.6F;
/// Of the blocks: the calmest ones tell the noise, and where it is local, also those of the calmer half.
constexpr double CALMEST_PART = 0.15;
constexpr double CALMER_PART = 0.5;
/// A search over shifts takes this many blocks, evenly spread.
constexpr int SEARCHED_BLOCKS = 256;
constexpr int MAX_SHIFTS = 256;  // set by hand: the time of a search grows with them
/// Local values: blocks in a row that give the median, its least number, and the most by which it may exceed
/// that of the whole image.
constexpr int LOCAL_BLOCKS = 7;
constexpr int MIN_LOCAL_BLOCKS = 6;
constexpr float MAX_LOCAL_RATIO = 4.0F;
constexpr int LOCAL_STEP_BLOCKS = 2;  // from one block that is looked at to the next
/// Slopes are summed in twelfths.
constexpr float SLOPE_UNIT = 12.0F;

/// Of the variances of differences to several views. Noise is alike in all of them. Texture that the search
/// over whole pixels left between two pixels is not: it depends on the view how far that is, and the views
/// for which it is least tell the noise.
float noiseOf(std::vector<float>& variances)
{
  const float median = medianOf(variances);
  const auto quarter = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 4);
  std::nth_element(variances.begin(), quarter, variances.end());
  return *quarter < MIN_ALIKE * median ? *quarter : median;
}

/// All views: the nearest one of every direction, then the second ones, and so on.
std::vector<std::size_t> nearestOfArms(const ViewSet& views)
{
  std::vector<std::size_t> chosen;
  for (int k = 0; chosen.size() < views.views.size(); ++k)
  {
    for (const Arm& arm : views.arms)
    {
      if (arm.first + k < arm.last)
      {
        chosen.push_back(static_cast<std::size_t>(arm.first + k));
      }
    }
  }
  return chosen;
}

std::vector<std::size_t> nearestViews(const LightField& light_field)
{
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    if (i != light_field.reference_index)
    {
      chosen.push_back(i);
    }
  }
  const auto distance = [&](std::size_t i)
  { return std::hypot(light_field.views[i].steps.x, light_field.views[i].steps.y); };
  std::stable_sort(chosen.begin(), chosen.end(),
                   [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  chosen.resize(std::min<std::size_t>(chosen.size(), VIEWS_COMPARED));
  return chosen;
}

/// Variance of the difference to the view at the shift where it is least; negative if the view shows the
/// block at none.
float leastVariance(const BlockPixels& reference, const View& view, const DisparityRange& range,
                    const NoiseBlock& block)
{
  const BlockPixels pixels = pixelsOf(view.image);
  const double widest = std::max(std::abs(view.steps.x), std::abs(view.steps.y));
  const int shifts = std::min(cvCeil((range.max - range.min) * widest) + 1, MAX_SHIFTS);
  float least = -1.0F;
  for (int i = 0; i < shifts; ++i)
  {
    const double disparity = range.min + (shifts > 1 ? i * (range.max - range.min) / (shifts - 1) : 0.0);
    const int x = block.x + cvRound(view.offset_px.x - disparity * view.steps.x);
    const int y = block.y + cvRound(view.offset_px.y - disparity * view.steps.y);
    if (isInside(pixels, x, y))
    {
      const DifferenceSums sums = sumDifferences(
          {reference.at(block.x, block.y), reference.row_stride, pixels.at(x, y), pixels.row_stride},
          BLOCK * reference.channels);
      const float here = blockVariance(sums, reference.channels);
      least = least < 0.0F ? here : std::min(least, here);
    }
  }
  return least;
}

/// Compares a block of prepared views at its disparity.
/// @param chosen the nearest first; farther ones are looked at where too few of the nearest show the block
///   near whole pixels: two plenoptic views in a row may be 0.3 to 0.7 px apart all over the image
void compareAt(const ViewSet& views, const std::vector<std::size_t>& chosen, float disparity,
               NoiseBlock& block)
{
  std::vector<float> values;
  std::vector<float> slopes;
  const BlockPixels reference = pixelsOf(views.reference);
  for (std::size_t k = 0; k < chosen.size() && (k < VIEWS_COMPARED || values.size() < MIN_VIEWS_COMPARED);
       ++k)
  {
    const PreparedView& view = views.views[chosen[k]];
    const BlockPixels pixels = pixelsOf(view.image);
    const double shift_x = view.offset_px.x - static_cast<double>(disparity) * view.steps.x;
    const double shift_y = view.offset_px.y - static_cast<double>(disparity) * view.steps.y;
    const int x = block.x + cvRound(shift_x);
    const int y = block.y + cvRound(shift_y);
    const double rest = std::hypot(shift_x - cvRound(shift_x), shift_y - cvRound(shift_y));
    if (rest > MAX_ROUNDED_PX || !isInside(pixels, x, y))
    {
      continue;
    }
    float value = 0.0F;
    float slope = 0.0F;
    for (int c = 0; c < reference.channels; ++c)
    {
      const BlockPair pair{reference.at(block.x, block.y) + c * reference.channel_stride,
                           reference.row_stride, pixels.at(x, y) + c * pixels.channel_stride,
                           pixels.row_stride};
      value += blockVariance(sumDifferences(pair, BLOCK), 1);
      slope += static_cast<float>(sumSlopes(pair));
    }
    values.push_back(value / static_cast<float>(reference.channels));
    slopes.push_back(
        slope / (SLOPE_UNIT * SLOPE_UNIT * 2.0F * BLOCK * BLOCK * static_cast<float>(reference.channels)));
  }
  if (values.size() >= MIN_VIEWS_COMPARED)
  {
    // The difference of two views has the noise of both.
    block.value = 0.5F * medianOf(values);
    block.slope = 0.5F * medianOf(slopes);
  }
}

/// Of the slopes of the blocks about one, or `overall` where too few have any.
float localSlope(NoiseBlockGrid& grid, int middle_x, int middle_y, float overall)
{
  constexpr int reach = LOCAL_BLOCKS / 2;
  std::vector<float> near;
  for (int y = std::max(middle_y - reach, 0); y <= std::min(middle_y + reach, grid.rows() - 1); ++y)
  {
    for (int x = std::max(middle_x - reach, 0); x <= std::min(middle_x + reach, grid.columns() - 1); ++x)
    {
      if (grid.at(x, y).slope >= 0.0F)
      {
        near.push_back(grid.at(x, y).slope);
      }
    }
  }
  return near.size() < MIN_LOCAL_BLOCKS ? overall : std::min(medianOf(near), MAX_LOCAL_RATIO * overall);
}

/// Medians over the blocks about every second one, between them by interpolation.
void setLocalSlopes(NoiseBlockGrid& grid, const cv::Size& size, float overall, ThreadPool& pool,
                    cv::Mat& local)
{
  const auto cells = [](int blocks)
  { return std::max(1, (blocks + LOCAL_STEP_BLOCKS - 1) / LOCAL_STEP_BLOCKS); };
  cv::Mat medians(cells(grid.rows()), cells(grid.columns()), CV_32FC1);
  pool.parallelFor(0, medians.rows, 1,
                   [&](int first, int last)
                   {
                     for (int row = first; row < last; ++row)
                     {
                       for (int column = 0; column < medians.cols; ++column)
                       {
                         medians.at<float>(row, column) =
                             localSlope(grid, column * LOCAL_STEP_BLOCKS, row * LOCAL_STEP_BLOCKS, overall);
                       }
                     }
                   });
  cv::resize(medians, local, size, 0.0, 0.0, cv::INTER_LINEAR);
}

}  // namespace

float estimateNoiseOfViews(const LightField& light_field, const DisparityRange& range, ThreadPool& pool)
{
  const BlockPixels reference = pixelsOf(light_field.reference().image);
  const int all = NoiseBlockGrid::count(reference.size.width, BLOCK) *
                  NoiseBlockGrid::count(reference.size.height, BLOCK);
  const int step = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(all) / SEARCHED_BLOCKS)));
  NoiseBlockGrid grid(reference.size, step);
  findChanges(reference, pool, grid);
  const int limit = calmLimit(grid.blocks(), CALMEST_PART);
  const std::vector<std::size_t> chosen = nearestViews(light_field);
  auto& blocks = grid.blocks();
  const auto compare = [&](NoiseBlock& block)
  {
    std::vector<float> values;
    for (const std::size_t i : chosen)
    {
      const float value = leastVariance(reference, light_field.views[i], range, block);
      if (value >= 0.0F)
      {
        values.push_back(value);
      }
    }
    if (values.size() >= MIN_VIEWS_COMPARED)
    {
      block.value = 0.5F * noiseOf(values);
    }
  };
  pool.parallelFor(0, static_cast<int>(blocks.size()), 16,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       if (blocks[i].midtone && blocks[i].change <= limit)
                       {
                         compare(blocks[i]);
                       }
                     }
                   });
  return std::sqrt(medianOfCalm(blocks, limit, &NoiseBlock::value));
}

/// From every second block, as the black fields of a chessboard: all of them tell no more
/// (docs/experiments.md).
void measureViewNoise(const ViewSet& views, const cv::Mat& disparity, ThreadPool& pool, ViewNoise& noise)
{
  NoiseBlockGrid grid({views.width(), views.height()}, 1);
  findChanges(pixelsOf(views.reference), pool, grid);
  const int calmest = calmLimit(grid.blocks(), CALMEST_PART);
  const int calmer = calmLimit(grid.blocks(), CALMER_PART);
  const std::vector<std::size_t> chosen = nearestOfArms(views);
  pool.parallelFor(0, grid.rows(), NOISE_BLOCK_ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int row = first; row < last; ++row)
                     {
                       for (int column = 0; column < grid.columns(); ++column)
                       {
                         NoiseBlock& block = grid.at(column, row);
                         if (block.change <= calmer && (row + column) % 2 == 0)
                         {
                           compareAt(views, chosen,
                                     disparity.at<float>(block.y + BLOCK / 2, block.x + BLOCK / 2), block);
                         }
                       }
                     }
                   });
  noise.value_variance = medianOfCalm(grid.blocks(), calmest, &NoiseBlock::value);
  noise.slope_variance = medianOfCalm(grid.blocks(), calmest, &NoiseBlock::slope);
  setLocalSlopes(grid, disparity.size(), noise.slope_variance, pool, noise.local_slope_variance);
}

}  // namespace light_field_depth::multiview
