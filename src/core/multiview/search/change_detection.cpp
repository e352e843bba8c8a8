#include "core/multiview/search/change_detection.h"

#include <algorithm>
#include <numeric>

namespace light_field_depth::multiview
{
namespace
{
// Costs in the units of FULL_COST.

/// The costs of all labels are computed in one row of so many, whatever the bands.
constexpr int OBSERVED_ROW_STRIDE = 8;
constexpr int OBSERVED_ROW = 3;  // the same of every tile
constexpr int SAMPLES_PER_TILE = TILE_PX * TILE_PX / OBSERVED_ROW_STRIDE;
/// A label outside the band speaks against it if its cost is lower by this.
constexpr int CLEARLY_BETTER = 30;
/// Pixels of SAMPLES_PER_TILE that must say so before the tile is searched in full.
constexpr int MIN_OUTSIDE_PIXELS = 3;
/// Share of the tiles that must be searched in full before the scene counts as another one.
constexpr float MAX_CHANGED_TILES = 0.35F;
/// A pixel whose best cost of all is above this has its disparity outside the range, or is occluded.
constexpr int UNEXPLAINED_COST = 120;
/// More such pixels in a tile than in the last frame there mean that something has left the range.
constexpr int UNEXPLAINED_MORE = 24;
/// Such pixels in the whole image: times those of the last frame that was searched in full, and as a share.
constexpr float UNEXPLAINED_GROWTH = 1.5F;
constexpr float UNEXPLAINED_MORE_SHARE = 0.01F;
/// More pixels at the first or last label than in the last frame that was searched in full, as a share.
constexpr float AT_ENDS_MORE_SHARE = 0.003F;

/// Pixels that have the first or the last label.
int countAtEnds(const cv::Mat& disparity, const LabelSpace& labels)
{
  // Nearer to the first or last label than to any other.
  constexpr float half_label = 0.5F;
  const float lowest = labels.disparity(half_label);
  const float highest = labels.disparity(static_cast<float>(labels.count - 1) - half_label);
  int count = 0;
  for (int y = 0; y < disparity.rows; ++y)
  {
    const auto* const row = disparity.ptr<float>(y);
    for (int x = 0; x < disparity.cols; ++x)
    {
      count += (row[x] < lowest ? 1 : 0) + (row[x] > highest ? 1 : 0);
    }
  }
  return count;
}

/// Calls body(row, column) for a tile and the tiles around it.
template <typename Body>
void forTilesAround(int row, int column, int rows, int columns, const Body& body)
{
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows - 1); ++y)
  {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, columns - 1); ++x)
    {
      body(y, x);
    }
  }
}

}  // namespace

void ChangeDetector::begin(const LabelBands& bands)
{
  rows_ = bands.rows();
  columns_ = bands.columns();
  samples_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_), {});
}

bool ChangeDetector::wants(int y) const
{
  return y % OBSERVED_ROW_STRIDE == OBSERVED_ROW;
}

void ChangeDetector::observe(int y, const std::uint8_t* inside, const std::uint8_t* outside, int width)
{
  for (int x = 0; x < width; ++x)
  {
    TileSample& tile = samples_[index(y / TILE_PX, x / TILE_PX)];
    tile.outside += outside[x] + CLEARLY_BETTER < inside[x] ? 1 : 0;
    tile.unexplained += std::min(inside[x], outside[x]) > UNEXPLAINED_COST ? 1 : 0;
  }
}

int ChangeDetector::unexplainedIn(const std::vector<TileSample>& samples)
{
  return std::accumulate(samples.begin(), samples.end(), 0,
                         [](int sum, const TileSample& sample) { return sum + sample.unexplained; });
}

void ChangeDetector::acceptFull()
{
  unexplained_in_full_ = unexplainedIn(samples_);
  last_ = samples_;
}

int ChangeDetector::unexplainedAround(int row, int column) const
{
  int most = 0;
  forTilesAround(row, column, rows_, columns_,
                 [&](int y, int x) { most = std::max(most, last_[index(y, x)].unexplained); });
  return most;
}

bool ChangeDetector::hasLeftTheRange() const
{
  const float all = static_cast<float>(samples_.size()) * SAMPLES_PER_TILE;
  const float limit =
      static_cast<float>(unexplained_in_full_) * UNEXPLAINED_GROWTH + UNEXPLAINED_MORE_SHARE * all;
  if (static_cast<float>(unexplainedIn(samples_)) > limit)
  {
    return true;
  }
  for (int row = 0; row < rows_; ++row)
  {
    for (int column = 0; column < columns_; ++column)
    {
      if (samples_[index(row, column)].unexplained > unexplainedAround(row, column) + UNEXPLAINED_MORE)
      {
        return true;
      }
    }
  }
  return false;
}

bool ChangeDetector::acceptNear(LabelBands& bands, std::vector<std::uint8_t>& widened)
{
  const auto changed =
      std::count_if(samples_.begin(), samples_.end(),
                    [&](const TileSample& sample) { return sample.outside >= MIN_OUTSIDE_PIXELS; });
  if (static_cast<float>(changed) > MAX_CHANGED_TILES * static_cast<float>(samples_.size()) ||
      hasLeftTheRange())
  {
    return false;
  }
  widened.assign(samples_.size(), 0);
  for (int row = 0; row < rows_; ++row)
  {
    for (int column = 0; column < columns_; ++column)
    {
      if (samples_[index(row, column)].outside < MIN_OUTSIDE_PIXELS)
      {
        continue;
      }
      forTilesAround(row, column, rows_, columns_,
                     [&](int y, int x)
                     {
                       widened[index(y, x)] = 1;
                       bands.at(y, x) = {0, bands.labels()};
                     });
    }
  }
  last_ = samples_;
  return true;
}

void ChangeDetector::acceptFullMap(const cv::Mat& disparity, const LabelSpace& labels)
{
  at_ends_in_full_ = countAtEnds(disparity, labels);
}

bool ChangeDetector::acceptNearMap(const cv::Mat& disparity, const LabelSpace& labels) const
{
  const auto more = static_cast<float>(countAtEnds(disparity, labels) - at_ends_in_full_);
  return more <= AT_ENDS_MORE_SHARE * static_cast<float>(disparity.total());
}

}  // namespace light_field_depth::multiview
