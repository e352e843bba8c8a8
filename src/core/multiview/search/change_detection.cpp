#include "core/multiview/search/change_detection.h"

#include <algorithm>
#include <numeric>

namespace light_field_depth::multiview
{
namespace
{
constexpr int SAMPLES_PER_TILE = TILE_PX * TILE_PX / WATCHED_ROW_STRIDE;

/// Pixels that have the first or the last label.
int countAtEnds(const cv::Mat& disparity, const LabelSpace& labels)
{
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

int unexplainedIn(const std::vector<TileSample>& samples)
{
  return std::accumulate(samples.begin(), samples.end(), 0,
                         [](int sum, const TileSample& sample) { return sum + sample.unexplained; });
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

bool ChangeDetector::hasLeftTheRange(const ChangeDetectionSettings& settings) const
{
  const float all = static_cast<float>(samples_.size()) * SAMPLES_PER_TILE;
  const float limit = static_cast<float>(unexplained_in_full_) * 1.5F + settings.unexplained_more_share * all;
  if (static_cast<float>(unexplainedIn(samples_)) > limit)
  {
    return true;
  }
  for (int row = 0; row < rows_; ++row)
  {
    for (int column = 0; column < columns_; ++column)
    {
      if (samples_[index(row, column)].unexplained >
          unexplainedAround(row, column) + settings.unexplained_more)
      {
        return true;
      }
    }
  }
  return false;
}

bool ChangeDetector::acceptNear(const ChangeDetectionSettings& settings, LabelBands& bands,
                                std::vector<std::uint8_t>& widened)
{
  const auto changed =
      std::count_if(samples_.begin(), samples_.end(),
                    [&](const TileSample& sample) { return sample.outside >= settings.outside_pixels; });
  if (static_cast<float>(changed) > settings.max_changed_tiles * static_cast<float>(samples_.size()) ||
      hasLeftTheRange(settings))
  {
    return false;
  }
  widened.assign(samples_.size(), 0);
  for (int row = 0; row < rows_; ++row)
  {
    for (int column = 0; column < columns_; ++column)
    {
      if (samples_[index(row, column)].outside < settings.outside_pixels)
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

bool ChangeDetector::acceptNearMap(const ChangeDetectionSettings& settings, const cv::Mat& disparity,
                                   const LabelSpace& labels) const
{
  const auto more = static_cast<float>(countAtEnds(disparity, labels) - at_ends_in_full_);
  return more <= settings.at_ends_more_share * static_cast<float>(disparity.total());
}

}  // namespace light_field_depth::multiview
