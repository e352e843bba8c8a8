#include "core/multiview/search/background_fusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/multiview/search/background_kernels.h"
#include "core/multiview/search/background_lines.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int TILES_PER_BLOCK = BLOCK_PX / TILE_PX;
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;
/// With fewer supported pixels about a block nothing is charged there.
constexpr int MIN_SUPPORTED_PIXELS = 30;
/// How much a label must be better than those at that distance to be supported, which is as wide as valleys
/// of the costs are. The label next to the bottom of a valley may lie half a label beside it. From 14 on the
/// dark floor of antinous goes to the wall behind; 8 and 10 are as good as 9.
constexpr float MIN_SUPPORT = 9.0F;
constexpr float SUPPORT_DISTANCE_PX = 0.25F;
/// Of the supported labels about a block: nothing is taken to be farther.
constexpr float FLOOR_QUANTILE = 0.05F;
/// Charge in later searches for leaving the background, what is free of it, and its limit. A blank wall has
/// nothing else to hold it: with 0.375 px free 11.5 instead of 9.2 % of the demo are off by 0.07 px. With
/// 0.19 px, or twice the charge, the wall of array/dolls is held where the first search was wrong.
constexpr float MOVED_CHARGE_PER_PX = 16.0F;
constexpr float MOVED_SLACK_PX = 0.25F;
constexpr int MAX_MOVED_CHARGE = 20;

SupportLine::Lines linesAbout(const CostVolume& volume, int tile_column, int y)
{
  return {lineAt(volume, tile_column, y - 1), lineAt(volume, tile_column, y),
          lineAt(volume, tile_column, y + 1)};
}

/// The sum over 3 x 3 pixels that a mean must exceed, given the mean over its 18 differences.
int thresholdOfSum(float mean)
{
  constexpr float differences = 18.0F;
  const auto exceeds = [&](int sum) { return static_cast<float>(sum) / differences > mean; };
  int threshold = -NO_SUPPORT;
  while (threshold < NO_SUPPORT && !exceeds(threshold + 1))
  {
    ++threshold;
  }
  return threshold;
}

/// Adds charge[i] to the costs of a pixel's labels first + i.
void addSaturated(const std::vector<std::uint8_t>& charge, int first, int x, int y, CostVolume& volume)
{
  const LabelBand& band = volume.bandAt(x, y);
  for (int label = std::max(first, band.first); label < band.end(); ++label)
  {
    std::uint8_t& cost = volume.values[volume.index(x, y, label)];
    cost = static_cast<std::uint8_t>(std::min(cost + charge[static_cast<std::size_t>(label - first)], 255));
  }
}

/// 0 for `slack` labels, then a ramp up to `limit`.
std::vector<std::uint8_t> ramp(int labels, float slack, float per_label, int limit)
{
  std::vector<std::uint8_t> charge(static_cast<std::size_t>(labels));
  for (std::size_t label = 0; label < charge.size(); ++label)
  {
    const float value = per_label * (static_cast<float>(label) - slack);
    charge[label] = static_cast<std::uint8_t>(std::clamp(cvRound(value), 0, limit));
  }
  return charge;
}

/// The label below which a share of the counts lies, or NO_LABEL if there are too few.
std::int16_t lowestSupported(const std::vector<int>& counts, float quantile)
{
  const int total = std::accumulate(counts.begin(), counts.end(), 0);
  if (total < MIN_SUPPORTED_PIXELS)
  {
    return NO_LABEL;
  }
  const float limit = quantile * static_cast<float>(total);
  std::size_t label = 0;
  int below = counts[0];
  while (static_cast<float>(below) <= limit)
  {
    ++label;
    below += counts[label];
  }
  return static_cast<std::int16_t>(label);
}

}  // namespace

void BackgroundFusion::prepare(const LabelSpace& labels, const cv::Mat& disparity, ThreadPool& pool,
                               CostVolume& volume)
{
  labels_ = labels;
  moved_.create(disparity.size(), CV_16SC1);
  label_.create(disparity.size(), CV_32FC1);
  data_cost_.create(disparity.size(), CV_32FC1);
  floor_.create((volume.height + BLOCK_PX - 1) / BLOCK_PX, (volume.width + BLOCK_PX - 1) / BLOCK_PX,
                CV_16SC1);
  countSupportedLabels(disparity, volume, pool);
  const auto charge = ramp(volume.bands.labels(), 0.0F, CHARGE_PER_PX * labels.step_px, MAX_CHARGE);
  pool.parallelFor(0, floor_.rows, 1,
                   [&](int first, int last)
                   {
                     for (int block_y = first; block_y < last; ++block_y)
                     {
                       chooseFloors(block_y, volume.bands.labels());
                       for (int block_x = 0; block_x < floor_.cols; ++block_x)
                       {
                         chargeBlock(block_x, block_y, charge, volume);
                       }
                     }
                   });
}

/// The labels that the images support, counted for each block in each row of tiles.
void BackgroundFusion::countSupportedLabels(const cv::Mat& disparity, const CostVolume& volume,
                                            ThreadPool& pool)
{
  const auto label_count = static_cast<std::size_t>(volume.bands.labels());
  const auto block_columns = static_cast<std::size_t>(floor_.cols);
  supported_.resize(static_cast<std::size_t>(volume.bands.rows()) * block_columns * label_count);
  const int threshold = thresholdOfSum(MIN_SUPPORT);
  const auto count_row = [&](int tile_row)
  {
    const cv::Range rows(tile_row * TILE_PX, std::min((tile_row + 1) * TILE_PX, volume.height));
    moved_.rowRange(rows).setTo(NO_LABEL);
    cv::Mat labels = label_.rowRange(rows);
    disparity.rowRange(rows).convertTo(labels, CV_32F, 1.0 / labels_.step_px,
                                       -labels_.first_px / labels_.step_px);
    int* const counts = &supported_[static_cast<std::size_t>(tile_row) * block_columns * label_count];
    std::fill_n(counts, block_columns * label_count, 0);
    for (int y = rows.start; y < rows.end; ++y)
    {
      for (int column = 0; column < volume.bands.columns(); ++column)
      {
        const auto block = static_cast<std::size_t>(column / TILES_PER_BLOCK);
        countSupportedLabels(column, y, threshold, volume, counts + block * label_count);
      }
    }
  };
  pool.parallelFor(0, volume.bands.rows(), 1,
                   [&](int first, int last)
                   {
                     for (int tile_row = first; tile_row < last; ++tile_row)
                     {
                       count_row(tile_row);
                     }
                   });
}

/// In one row of a tile; finds the costs of its labels as well.
void BackgroundFusion::countSupportedLabels(int tile_column, int y, int threshold, const CostVolume& volume,
                                            int* counts)
{
  const int x = tile_column * TILE_PX;
  const int width = std::min(TILE_PX, volume.width - x);
  std::array<std::int16_t, TILE_PX> labels;
  labels.fill(NO_LABEL);
  findLabelCosts({lineAt(volume, tile_column, y), label_.ptr<float>(y) + x, width,
                  data_cost_.ptr<float>(y) + x, labels.data()});
  if (y == 0 || y + 1 == volume.height)
  {
    return;
  }
  if (x + width == volume.width)
  {
    labels[static_cast<std::size_t>(width - 1)] = NO_LABEL;  // has no right neighbour
  }
  SupportLine support;
  support.here = linesAbout(volume, tile_column, y);
  support.left = linesAbout(volume, tile_column - 1, y);
  support.right = linesAbout(volume, tile_column + 1, y);
  support.distance = std::max(1, cvRound(SUPPORT_DISTANCE_PX / labels_.step_px));
  support.threshold = threshold;
  countSupported(support, labels.data(), counts);
}

/// The lowest label, but for a few, that the images support about each block of a row.
void BackgroundFusion::chooseFloors(int block_y, int labels)
{
  const auto label_count = static_cast<std::size_t>(labels);
  std::vector<int> about(label_count);
  const int tile_rows = static_cast<int>(supported_.size() / label_count) / floor_.cols;
  const int first_row = std::max(block_y - 1, 0) * TILES_PER_BLOCK;
  const int last_row = std::min((block_y + 2) * TILES_PER_BLOCK, tile_rows);
  for (int block_x = 0; block_x < floor_.cols; ++block_x)
  {
    std::fill(about.begin(), about.end(), 0);
    for (int row = first_row; row < last_row; ++row)
    {
      for (int x = std::max(block_x - 1, 0); x <= std::min(block_x + 1, floor_.cols - 1); ++x)
      {
        const std::ptrdiff_t block = static_cast<std::ptrdiff_t>(row) * floor_.cols + x;
        const auto counts = supported_.begin() + block * labels;
        std::transform(about.begin(), about.end(), counts, about.begin(), std::plus<>());
      }
    }
    floor_.at<std::int16_t>(block_y, block_x) = lowestSupported(about, FLOOR_QUANTILE);
  }
}

void BackgroundFusion::chargeBlock(int block_x, int block_y, const std::vector<std::uint8_t>& charge,
                                   CostVolume& volume) const
{
  const std::int16_t floor = floor_.at<std::int16_t>(block_y, block_x);
  if (floor == NO_LABEL)
  {
    return;
  }
  const int last_column = std::min((block_x + 1) * TILES_PER_BLOCK, volume.bands.columns());
  const int last_y = std::min((block_y + 1) * BLOCK_PX, volume.height);
  for (int column = block_x * TILES_PER_BLOCK; column < last_column; ++column)
  {
    for (int y = block_y * BLOCK_PX; y < last_y; ++y)
    {
      const LabelBand& band = volume.bands.at(y / TILE_PX, column);
      const int first = std::max<int>(floor, band.first);
      if (first < band.end())
      {
        addCharges(&charge[static_cast<std::size_t>(first - floor)], band.end() - first,
                   &volume.values[volume.index(column * TILE_PX, y, first)]);
      }
    }
  }
}

void BackgroundFusion::chargeMoved(const LabelSpace& labels, ThreadPool& pool, CostVolume& volume) const
{
  const auto charge = ramp(volume.bands.labels(), MOVED_SLACK_PX / labels.step_px,
                           MOVED_CHARGE_PER_PX * labels.step_px, MAX_MOVED_CHARGE);
  const auto first_charged = [&](std::int16_t moved_label)
  { return std::max(0, cvRound(labels.label(labels_.disparity(static_cast<float>(moved_label))))); };
  pool.parallelFor(0, volume.height, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       for (int x = 0; x < volume.width; ++x)
                       {
                         const std::int16_t label = moved_.at<std::int16_t>(y, x);
                         if (label != NO_LABEL)
                         {
                           addSaturated(charge, first_charged(label), x, y, volume);
                         }
                       }
                     }
                   });
}

}  // namespace light_field_depth::multiview
