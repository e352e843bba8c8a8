#include "light_field_depth/core/multiview/background_fusion.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace light_field_depth::multiview
{
namespace
{
constexpr int BLOCK_PX = 2 * TILE_PX;
constexpr int ROWS_PER_CHUNK = 16;
/// With fewer believed pixels about a block nothing is charged there.
constexpr int MIN_BELIEVED = 30;
constexpr std::int16_t NONE = -1;

/// The cost between two labels of the pixel's band.
float interpolatedCost(const CostVolume& volume, int x, int y, float label)
{
  const LabelBand& band = volume.bandAt(x, y);
  if (band.count == 1)
  {
    return volume.at(x, y, band.first);
  }
  const float inside = std::clamp(label, static_cast<float>(band.first), static_cast<float>(band.end() - 1));
  const int below = std::min(static_cast<int>(inside), band.end() - 2);
  const float part = inside - static_cast<float>(below);
  const std::size_t index = volume.index(x, y, below);
  return static_cast<float>(volume.values[index]) * (1.0F - part) +
         static_cast<float>(volume.values[index + TILE_PX]) * part;
}

/// Whether a label and those `distance` away on both sides are in the bands of 3 x 3 pixels.
bool isComparable(const CostVolume& volume, int x, int y, int label, int distance)
{
  if (x < 1 || y < 1 || x + 1 >= volume.width || y + 1 >= volume.height)
  {
    return false;
  }
  const auto holds = [&](int at_x, int at_y)
  {
    const LabelBand& band = volume.bandAt(at_x, at_y);
    return band.contains(label - distance) && band.contains(label + distance);
  };
  return holds(x - 1, y - 1) && holds(x + 1, y - 1) && holds(x - 1, y + 1) && holds(x + 1, y + 1);
}

/// The mean over 3 x 3 pixels of how much worse the labels `distance` away on both sides are.
float support(const CostVolume& volume, int x, int y, int label, int distance)
{
  int sum = 0;
  for (int dy = -1; dy <= 1; ++dy)
  {
    for (int dx = -1; dx <= 1; ++dx)
    {
      const auto cost = [&](int other) { return static_cast<int>(volume.at(x + dx, y + dy, other)); };
      sum += cost(label - distance) + cost(label + distance) - 2 * cost(label);
    }
  }
  return static_cast<float>(sum) / 18.0F;
}

/// What the labels from `first` on are charged: charge[i] for label first + i.
struct Charge
{
  const std::vector<std::uint8_t>& charge;
  int first;
};

/// Adds a charge to the costs of a pixel and of `count - 1` more on its right in the same tile.
void addSaturated(const Charge& charge, int x, int y, int count, CostVolume& volume)
{
  const LabelBand& band = volume.bandAt(x, y);
  for (int label = std::max(charge.first, band.first); label < band.end(); ++label)
  {
    const int added = charge.charge[static_cast<std::size_t>(label - charge.first)];
    std::uint8_t* const costs = volume.values.data() + volume.index(x, y, label);
    for (int i = 0; i < count; ++i)
    {
      costs[i] = static_cast<std::uint8_t>(std::min(costs[i] + added, 255));
    }
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

/// The label below which a share of the counts lies, or NONE if there are too few.
std::int16_t lowestBelieved(const std::vector<int>& counts, float quantile)
{
  const int total = std::accumulate(counts.begin(), counts.end(), 0);
  if (total < MIN_BELIEVED)
  {
    return NONE;
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

/// What a region costs in one of the two maps.
struct Energy
{
  double data = 0.0;
  double links = 0.0;

  double total() const { return data + links; }
};

}  // namespace

float BackgroundFusion::biasAt(int x, int y, float label) const
{
  const std::int16_t floor = floor_.at<std::int16_t>(y / BLOCK_PX, x / BLOCK_PX);
  return floor == NONE
             ? 0.0F
             : std::clamp(settings_.bias_per_px * labels_.step_px * (label - static_cast<float>(floor)), 0.0F,
                          static_cast<float>(settings_.max_bias));
}

void BackgroundFusion::prepare(const LabelSpace& labels, const cv::Mat& disparity,
                               const BackgroundSettings& settings, ThreadPool& pool, CostVolume& volume)
{
  labels_ = labels;
  settings_ = settings;
  moved_.create(disparity.size(), CV_16SC1);
  moved_.setTo(NONE);
  disparity.convertTo(label_, CV_32F, 1.0 / labels.step_px, -labels.first_px / labels.step_px);
  findFloors(volume, pool);
  const auto charge =
      ramp(volume.bands.labels(), 0.0F, settings.bias_per_px * labels.step_px, settings.max_bias);
  pool.parallelFor(0, floor_.rows, 1,
                   [&](int first, int last)
                   {
                     for (int block_y = first; block_y < last; ++block_y)
                     {
                       for (int block_x = 0; block_x < floor_.cols; ++block_x)
                       {
                         chargeBlock(block_x, block_y, charge, volume);
                       }
                     }
                   });
}

void BackgroundFusion::chargeBlock(int block_x, int block_y, const std::vector<std::uint8_t>& charge,
                                   CostVolume& volume) const
{
  const std::int16_t floor = floor_.at<std::int16_t>(block_y, block_x);
  if (floor == NONE)
  {
    return;
  }
  const int last_x = std::min((block_x + 1) * BLOCK_PX, volume.width);
  const int last_y = std::min((block_y + 1) * BLOCK_PX, volume.height);
  for (int y = block_y * BLOCK_PX; y < last_y; ++y)
  {
    for (int x = block_x * BLOCK_PX; x < last_x; x += TILE_PX)
    {
      addSaturated({charge, floor}, x, y, std::min(TILE_PX, last_x - x), volume);
    }
  }
}

/// The lowest label, but for a few, that the images support about every block.
void BackgroundFusion::findFloors(const CostVolume& volume, ThreadPool& pool)
{
  data_cost_.create(label_.size(), CV_32FC1);
  supported_.create(label_.size(), CV_16SC1);
  const int distance = std::max(1, cvRound(settings_.support_distance_px / labels_.step_px));
  const auto believed = [&](int x, int y)
  {
    const int label = cvRound(label_.at<float>(y, x));
    return isComparable(volume, x, y, label, distance) &&
                   support(volume, x, y, label, distance) > settings_.min_support
               ? static_cast<std::int16_t>(label)
               : NONE;
  };
  pool.parallelFor(0, volume.height, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       for (int x = 0; x < volume.width; ++x)
                       {
                         data_cost_.at<float>(y, x) = interpolatedCost(volume, x, y, label_.at<float>(y, x));
                         supported_.at<std::int16_t>(y, x) = believed(x, y);
                       }
                     }
                   });
  floor_.create((volume.height + BLOCK_PX - 1) / BLOCK_PX, (volume.width + BLOCK_PX - 1) / BLOCK_PX,
                CV_16SC1);
  chooseFloors(volume.bands.labels());
}

void BackgroundFusion::chooseFloors(int labels)
{
  const auto label_count = static_cast<std::size_t>(labels);
  std::vector<int> counts(floor_.total() * label_count);
  const auto counts_of = [&](int block_x, int block_y)
  { return counts.begin() + static_cast<std::ptrdiff_t>(label_count) * (block_y * floor_.cols + block_x); };
  for (int y = 0; y < supported_.rows; ++y)
  {
    for (int x = 0; x < supported_.cols; ++x)
    {
      const std::int16_t label = supported_.at<std::int16_t>(y, x);
      if (label != NONE)
      {
        ++*(counts_of(x / BLOCK_PX, y / BLOCK_PX) + label);
      }
    }
  }
  std::vector<int> about(label_count);
  for (int block_y = 0; block_y < floor_.rows; ++block_y)
  {
    for (int block_x = 0; block_x < floor_.cols; ++block_x)
    {
      std::fill(about.begin(), about.end(), 0);
      for (int y = std::max(block_y - 1, 0); y <= std::min(block_y + 1, floor_.rows - 1); ++y)
      {
        for (int x = std::max(block_x - 1, 0); x <= std::min(block_x + 1, floor_.cols - 1); ++x)
        {
          std::transform(about.begin(), about.end(), counts_of(x, y), about.begin(), std::plus<>());
        }
      }
      floor_.at<std::int16_t>(block_y, block_x) = lowestBelieved(about, settings_.floor_quantile);
    }
  }
}

/// A connected part of the image that the second search places farther.
struct BackgroundFusion::Region
{
  int pixels = 0;
  Energy kept;
  Energy moved;

  /// Texture that speaks against the move shows in the data alone, however smooth the result would be.
  bool accepted(const BackgroundSettings& settings) const
  {
    const double rise = moved.data - kept.data;
    return moved.total() < settings.accepted_energy * kept.total() &&
           rise < settings.max_data_rise * kept.data && rise < settings.max_cost_rise * pixels;
  }
};

void BackgroundFusion::fuse(const CostVolume& volume, const PathAggregator& paths,
                            const PathSettings& path_settings, const cv::Mat& background, cv::Mat& disparity)
{
  const cv::Mat farther = disparity - background > settings_.min_drop_px;
  const int count = cv::connectedComponents(farther, regions_, 4, CV_32S);
  if (count == 1)
  {
    return;
  }
  std::vector<Region> regions(static_cast<std::size_t>(count));
  addData(volume, background, regions);
  addLinks(paths, path_settings, background, regions);
  for (int y = 0; y < volume.height; ++y)
  {
    for (int x = 0; x < volume.width; ++x)
    {
      const std::size_t region = regionAt(x, y);
      if (region != 0 && regions[region].accepted(settings_))
      {
        disparity.at<float>(y, x) = background.at<float>(y, x);
        const int label = cvRound(labels_.label(background.at<float>(y, x)));
        moved_.at<std::int16_t>(y, x) = static_cast<std::int16_t>(std::max(0, label));
      }
    }
  }
}

void BackgroundFusion::addData(const CostVolume& volume, const cv::Mat& background,
                               std::vector<Region>& regions) const
{
  for (int y = 0; y < volume.height; ++y)
  {
    for (int x = 0; x < volume.width; ++x)
    {
      const std::size_t region = regionAt(x, y);
      if (region != 0)
      {
        const float label = labels_.label(background.at<float>(y, x));
        const float cost = interpolatedCost(volume, x, y, label);
        ++regions[region].pixels;
        regions[region].kept.data += data_cost_.at<float>(y, x);
        regions[region].moved.data += cost - biasAt(x, y, label);
      }
    }
  }
}

/// The links between neighbours of which at least one lies in a region.
void BackgroundFusion::addLinks(const PathAggregator& paths, const PathSettings& settings,
                                const cv::Mat& background, std::vector<Region>& regions) const
{
  const auto moved_label = [&](int x, int y)
  { return regionAt(x, y) != 0 ? labels_.label(background.at<float>(y, x)) : label_.at<float>(y, x); };
  const auto add = [&](int x, int y, int other_x, int other_y, std::uint16_t large_step)
  {
    const std::size_t region = std::max(regionAt(x, y), regionAt(other_x, other_y));
    const auto cost = [&](float change)
    {
      return std::min(static_cast<float>(settings.small_step) * std::abs(change),
                      static_cast<float>(large_step));
    };
    regions[region].kept.links += cost(label_.at<float>(y, x) - label_.at<float>(other_y, other_x));
    regions[region].moved.links += cost(moved_label(x, y) - moved_label(other_x, other_y));
  };
  for (int y = 0; y < label_.rows; ++y)
  {
    for (int x = 0; x < label_.cols; ++x)
    {
      const std::size_t here = regionAt(x, y);
      if (x > 0 && (here != 0 || regionAt(x - 1, y) != 0))
      {
        add(x, y, x - 1, y, paths.stepLeft(x, y));
      }
      if (y > 0 && (here != 0 || regionAt(x, y - 1) != 0))
      {
        add(x, y, x, y - 1, paths.stepAbove(x, y));
      }
    }
  }
}

void BackgroundFusion::hold(ThreadPool& pool, CostVolume& volume) const
{
  const auto charge = ramp(volume.bands.labels(), settings_.hold_slack_px / labels_.step_px,
                           settings_.hold_per_px * labels_.step_px, settings_.max_hold);
  pool.parallelFor(0, volume.height, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       for (int x = 0; x < volume.width; ++x)
                       {
                         const std::int16_t label = moved_.at<std::int16_t>(y, x);
                         if (label != NONE)
                         {
                           addSaturated({charge, label}, x, y, 1, volume);
                         }
                       }
                     }
                   });
}

}  // namespace light_field_depth::multiview
