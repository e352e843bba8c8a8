#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "core/multiview/search/background_fusion.h"
#include "core/multiview/search/background_lines.h"

namespace light_field_depth::multiview
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;
/// The same of one sum of energies, which is of as many numbers as there are regions. What is summed does
/// depend on it, by rounding.
constexpr int ROWS_PER_SUM = 32;
/// Smaller differences of the two searches are left alone. With twice as much, more of the blank wall of
/// array/dolls stays at what stands before it.
constexpr float MIN_DROP_PX = 0.08F;
/// A region moves back only if its energy stays below this share, its matching cost rises by less than this
/// share of itself, and by less than this a pixel. The matching cost tells blank regions from dark ones: it
/// rises by 0 to 3 % where blank walls move back (array/dolls, demo, lytro/general_11), by 6 to 26 % where
/// the dark floor of antinous would go to the wall behind, the less the more noise adds to both. Energies
/// from 0.95 to 1.1 give the same maps within 3 %.
constexpr double MAX_ENERGY_SHARE = 1.1F;
constexpr double MAX_DATA_RISE = 0.045F;
constexpr double MAX_COST_RISE = 4.0F;

/// The cost between two labels of the pixel's band.
float interpolatedCost(const CostVolume& volume, int x, int y, float label)
{
  TileLine line = lineAt(volume, x / TILE_PX, y);
  line.costs += x % TILE_PX;
  float cost = 0.0F;
  std::int16_t rounded = NO_LABEL;
  findLabelCostsPlain({line, &label, 1, &cost, &rounded});
  return cost;
}

/// Pixels of a row that are passed over at once where nothing is marked.
constexpr int RUN_PX = 64;

bool isMarked(const std::uint8_t* marks, int count)
{
  return std::memchr(marks, 1, static_cast<std::size_t>(count)) != nullptr;
}

/// What a region costs in one of the two maps.
struct Energy
{
  double data = 0.0;
  double links = 0.0;

  double total() const { return data + links; }
  void add(const Energy& other)
  {
    data += other.data;
    links += other.links;
  }
};

}  // namespace

float BackgroundFusion::biasAt(int x, int y, float label) const
{
  const std::int16_t floor = floor_.at<std::int16_t>(y / BLOCK_PX, x / BLOCK_PX);
  return floor == NO_LABEL ? 0.0F
                           : std::clamp(CHARGE_PER_PX * labels_.step_px * (label - static_cast<float>(floor)),
                                        0.0F, static_cast<float>(MAX_CHARGE));
}

/// A connected part of the image that the second search places farther.
struct BackgroundFusion::Region
{
  int pixels = 0;
  Energy kept;
  Energy moved;

  void add(const Region& other)
  {
    pixels += other.pixels;
    kept.add(other.kept);
    moved.add(other.moved);
  }

  /// Texture that speaks against the move shows in the data alone, however smooth the result would be.
  bool accepted() const
  {
    const double rise = moved.data - kept.data;
    return moved.total() < MAX_ENERGY_SHARE * kept.total() && rise < MAX_DATA_RISE * kept.data &&
           rise < MAX_COST_RISE * pixels;
  }
};

void BackgroundFusion::fuse(const CostVolume& volume, const PathAggregator& paths,
                            const PathSettings& path_settings, const cv::Mat& background, ThreadPool& pool,
                            cv::Mat& disparity)
{
  if (!markFarther(background, pool, disparity))
  {
    return;
  }
  const int count = cv::connectedComponents(farther_, regions_, 4, CV_32S);
  const std::vector<Region> regions =
      addRegions(volume, paths, path_settings, background, static_cast<std::size_t>(count), pool);
  const auto move = [&](int x, int y)
  {
    if (regions[regionAt(x, y)].accepted())
    {
      disparity.at<float>(y, x) = background.at<float>(y, x);
      const int label = cvRound(labels_.label(background.at<float>(y, x)));
      moved_.at<std::int16_t>(y, x) = static_cast<std::int16_t>(std::max(0, label));
    }
  };
  pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                   [&](int first, int last) {
                     forFarther({first, last}, move);
                   });
}

/// Chunks of rows are added up each for itself, then in their order.
std::vector<BackgroundFusion::Region> BackgroundFusion::addRegions(const CostVolume& volume,
                                                                   const PathAggregator& paths,
                                                                   const PathSettings& settings,
                                                                   const cv::Mat& background,
                                                                   std::size_t count, ThreadPool& pool) const
{
  const int chunks = (farther_.rows + ROWS_PER_SUM - 1) / ROWS_PER_SUM;
  std::vector<std::vector<Region>> parts(static_cast<std::size_t>(chunks), std::vector<Region>(count));
  pool.parallelFor(0, farther_.rows, ROWS_PER_SUM,
                   [&](int first, int last)
                   {
                     std::vector<Region>& part = parts[static_cast<std::size_t>(first / ROWS_PER_SUM)];
                     addData(volume, background, {first, last}, part);
                     addLinks(paths, settings, background, {first, last}, part);
                   });
  for (std::size_t chunk = 1; chunk < parts.size(); ++chunk)
  {
    for (std::size_t region = 0; region < count; ++region)
    {
      parts[0][region].add(parts[chunk][region]);
    }
  }
  return parts.front();
}

/// Where the second search is farther.
/// @return whether it is anywhere
bool BackgroundFusion::markFarther(const cv::Mat& background, ThreadPool& pool, const cv::Mat& disparity)
{
  farther_.create(disparity.size(), CV_8UC1);
  marked_rows_.assign(static_cast<std::size_t>(disparity.rows), 0);
  pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       const auto* const here = disparity.ptr<float>(y);
                       const auto* const there = background.ptr<float>(y);
                       auto* const farther = farther_.ptr<std::uint8_t>(y);
                       for (int x = 0; x < disparity.cols; ++x)
                       {
                         farther[x] = static_cast<std::uint8_t>(here[x] - there[x] > MIN_DROP_PX);
                       }
                       marked_rows_[static_cast<std::size_t>(y)] =
                           static_cast<std::uint8_t>(isMarked(farther, disparity.cols));
                     }
                   });
  return std::find(marked_rows_.begin(), marked_rows_.end(), 1) != marked_rows_.end();
}

/// Calls body(x, y) for the pixels in regions, row by row. They are few.
template <class Body>
void BackgroundFusion::forFarther(const cv::Range& rows, const Body& body) const
{
  for (int y = rows.start; y < rows.end; ++y)
  {
    const auto* const farther = farther_.ptr<std::uint8_t>(y);
    for (int begin = 0; begin < farther_.cols && isRowMarked(y); begin += RUN_PX)
    {
      const int end = std::min(begin + RUN_PX, farther_.cols);
      for (int x = begin; x < end && isMarked(farther + begin, end - begin); ++x)
      {
        if (farther[x] != 0)
        {
          body(x, y);
        }
      }
    }
  }
}

void BackgroundFusion::addData(const CostVolume& volume, const cv::Mat& background, const cv::Range& rows,
                               std::vector<Region>& regions) const
{
  forFarther(rows,
             [&](int x, int y)
             {
               Region& region = regions[regionAt(x, y)];
               const float label = labels_.label(background.at<float>(y, x));
               ++region.pixels;
               region.kept.data += data_cost_.at<float>(y, x);
               region.moved.data += interpolatedCost(volume, x, y, label) - biasAt(x, y, label);
             });
}

/// The links between neighbours of which at least one lies in a region.
void BackgroundFusion::addLinks(const PathAggregator& paths, const PathSettings& settings,
                                const cv::Mat& background, const cv::Range& rows,
                                std::vector<Region>& regions) const
{
  const auto moved_label = [&](int x, int y)
  { return regionAt(x, y) != 0 ? labels_.label(background.at<float>(y, x)) : label_.at<float>(y, x); };
  const auto add = [&](int x, int y, int other_x, int other_y, std::uint16_t large_change_penalty)
  {
    const std::size_t region = std::max(regionAt(x, y), regionAt(other_x, other_y));
    const auto cost = [&](float change)
    {
      return std::min(static_cast<float>(settings.small_change_penalty) * std::abs(change),
                      static_cast<float>(large_change_penalty));
    };
    regions[region].kept.links += cost(label_.at<float>(y, x) - label_.at<float>(other_y, other_x));
    regions[region].moved.links += cost(moved_label(x, y) - moved_label(other_x, other_y));
  };
  const auto add_of = [&](int x, int y)
  {
    const bool here = regionAt(x, y) != 0;
    if (x > 0 && (here || regionAt(x - 1, y) != 0))
    {
      add(x, y, x - 1, y, paths.stepLeft(x, y));
    }
    if (y > 0 && (here || regionAt(x, y - 1) != 0))
    {
      add(x, y, x, y - 1, paths.stepAbove(x, y));
    }
  };
  for (int y = rows.start; y < rows.end; ++y)
  {
    const int above = std::max(y - 1, 0);
    for (int begin = 0; begin < label_.cols && (isRowMarked(y) || isRowMarked(above)); begin += RUN_PX)
    {
      const int end = std::min(begin + RUN_PX, label_.cols);
      const int before = std::max(begin - 1, 0);
      if (isMarked(farther_.ptr<std::uint8_t>(y) + before, end - before) ||
          isMarked(farther_.ptr<std::uint8_t>(above) + begin, end - begin))
      {
        for (int x = begin; x < end; ++x)
        {
          add_of(x, y);
        }
      }
    }
  }
}

}  // namespace light_field_depth::multiview
