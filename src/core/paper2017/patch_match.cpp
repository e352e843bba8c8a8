#include "core/paper2017/patch_match.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/paper2017/epipolar_line.h"

namespace light_field_depth
{
namespace
{
/// A level has settled when a sweep changes fewer seeds than this fraction.
constexpr double SETTLED_FRACTION = 0.01;

/// A number that depends on nothing but its arguments, so that no order of work changes the result.
std::uint32_t hashed(std::uint32_t level, std::uint32_t sweep, std::uint32_t seed, std::uint32_t sample)
{
  std::uint32_t h = level * 0x9E3779B9U ^ sweep * 0x85EBCA6BU ^ seed * 0xC2B2AE35U ^ sample * 0x27D4EB2FU;
  h ^= h >> 16;
  h *= 0x7FEB352DU;
  h ^= h >> 15;
  h *= 0x846CA68BU;
  h ^= h >> 16;
  return h;
}

/// Pixels of one axis at which seeds stand on a level, and where the seeds of the full size are among them.
struct SeedAxis
{
  std::vector<int> positions_px;     ///< strictly increasing
  std::vector<int> index_of_finest;  ///< for each seed of the full size
};

/// Seeds that fall on one pixel of a coarse level are one there.
SeedAxis seedAxis(const std::vector<int>& finest_px, double scale, int length)
{
  SeedAxis axis;
  for (const int finest : finest_px)
  {
    const int position = std::clamp(cvRound((finest + 0.5) * scale - 0.5), 0, length - 1);
    if (axis.positions_px.empty() || axis.positions_px.back() < position)
    {
      axis.positions_px.push_back(position);
    }
    axis.index_of_finest.push_back(static_cast<int>(axis.positions_px.size()) - 1);
  }
  return axis;
}

/// Seeds of the full size, a block of the spacing around each, centred in the image.
std::vector<int> finestSeeds(int length, int spacing)
{
  const int count = std::max(1, length / spacing);
  const int first = (length - (count - 1) * spacing) / 2;
  std::vector<int> positions(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
  {
    positions[static_cast<std::size_t>(i)] = std::min(length - 1, first + i * spacing);
  }
  return positions;
}

/// PatchMatch on one level of the pyramid.
class LevelSearch
{
public:
  LevelSearch(const DescriptorImage& from, const DescriptorImage& to, EpipolarLine line, SeedAxis columns,
              SeedAxis rows, std::uint32_t level)
      : from_(&from), to_(&to), line_(std::move(line)), columns_(std::move(columns)), rows_(std::move(rows)),
        level_(level), displacement_(seedCount()), cost_(seedCount())
  {
  }

  void initialiseAtRandom();
  void initialiseFrom(const LevelSearch& coarser, double ratio);
  void search(int sweeps, int radius);
  SeedMatches matches(bool subpixel) const;

private:
  int columnCount() const { return static_cast<int>(columns_.positions_px.size()); }
  int rowCount() const { return static_cast<int>(rows_.positions_px.size()); }
  std::size_t seedCount() const { return columns_.positions_px.size() * rows_.positions_px.size(); }
  std::size_t seedIndex(int column, int row) const
  {
    return static_cast<std::size_t>(row) * columns_.positions_px.size() + static_cast<std::size_t>(column);
  }

  cv::Point pixelOf(int column, int row) const
  {
    return {columns_.positions_px[static_cast<std::size_t>(column)],
            rows_.positions_px[static_cast<std::size_t>(row)]};
  }

  int costAt(int column, int row, int displacement) const;
  void start(int column, int row, int displacement);
  bool tryDisplacement(int column, int row, std::size_t seed, int displacement);
  bool propagate(int column, int row, std::size_t seed, int towards);
  bool searchAround(int column, int row, std::size_t seed, int radius, std::uint32_t sweep);
  int sweepOnce(int sweep, int radius);

  const DescriptorImage* from_;
  const DescriptorImage* to_;
  EpipolarLine line_;
  SeedAxis columns_;
  SeedAxis rows_;
  std::uint32_t level_;
  std::vector<int> displacement_;
  std::vector<int> cost_;
};

/// Costs more than any match.
constexpr int OUTSIDE = DescriptorImage::MAX_DISTANCE + 1;

int LevelSearch::costAt(int column, int row, int displacement) const
{
  const cv::Point pixel = pixelOf(column, row);
  const cv::Point target = line_.target(pixel, displacement);
  if (target.x < 0 || target.y < 0 || target.x >= to_->size().width || target.y >= to_->size().height)
  {
    return OUTSIDE;
  }
  return descriptorDistance(from_->at(pixel.x, pixel.y), from_->stride(), to_->at(target.x, target.y),
                            to_->stride());
}

void LevelSearch::start(int column, int row, int displacement)
{
  const std::size_t seed = seedIndex(column, row);
  displacement_[seed] = std::clamp(displacement, line_.min(), line_.max());
  cost_[seed] = costAt(column, row, displacement_[seed]);
}

bool LevelSearch::tryDisplacement(int column, int row, std::size_t seed, int displacement)
{
  if (displacement == displacement_[seed] || displacement < line_.min() || displacement > line_.max())
  {
    return false;
  }
  const int cost = costAt(column, row, displacement);
  if (cost >= cost_[seed])
  {
    return false;
  }
  displacement_[seed] = displacement;
  cost_[seed] = cost;
  return true;
}

void LevelSearch::initialiseAtRandom()
{
  const auto choices = static_cast<std::uint32_t>(line_.max() - line_.min() + 1);
  for (int row = 0; row < rowCount(); ++row)
  {
    for (int column = 0; column < columnCount(); ++column)
    {
      const auto seed = static_cast<std::uint32_t>(seedIndex(column, row));
      start(column, row, line_.min() + static_cast<int>(hashed(level_, 0, seed, 0) % choices));
    }
  }
}

/// Index on the coarse level of each seed of the fine one.
std::vector<int> parents(const SeedAxis& fine, const SeedAxis& coarse)
{
  std::vector<int> parent(fine.positions_px.size());
  for (std::size_t i = 0; i < fine.index_of_finest.size(); ++i)
  {
    parent[static_cast<std::size_t>(fine.index_of_finest[i])] = coarse.index_of_finest[i];
  }
  return parent;
}

void LevelSearch::initialiseFrom(const LevelSearch& coarser, double ratio)
{
  const std::vector<int> parent_columns = parents(columns_, coarser.columns_);
  const std::vector<int> parent_rows = parents(rows_, coarser.rows_);
  for (int row = 0; row < rowCount(); ++row)
  {
    for (int column = 0; column < columnCount(); ++column)
    {
      const std::size_t parent = coarser.seedIndex(parent_columns[static_cast<std::size_t>(column)],
                                                   parent_rows[static_cast<std::size_t>(row)]);
      start(column, row, cvRound(coarser.displacement_[parent] / ratio));
    }
  }
}

/// Takes over what the neighbours that this sweep has already visited found.
/// @param towards 1 in a sweep from the top left, -1 in one from the bottom right
bool LevelSearch::propagate(int column, int row, std::size_t seed, int towards)
{
  bool changed = false;
  const int previous_row = row - towards;
  const int previous_column = column - towards;
  const bool has_column = previous_column >= 0 && previous_column < columnCount();
  if (has_column)
  {
    changed |= tryDisplacement(column, row, seed, displacement_[seedIndex(previous_column, row)]);
  }
  if (previous_row >= 0 && previous_row < rowCount())
  {
    for (int c = std::max(0, column - 1); c <= std::min(columnCount() - 1, column + 1); ++c)
    {
      changed |= tryDisplacement(column, row, seed, displacement_[seedIndex(c, previous_row)]);
    }
  }
  return changed;
}

bool LevelSearch::searchAround(int column, int row, std::size_t seed, int radius, std::uint32_t sweep)
{
  bool changed = false;
  std::uint32_t sample = 1;
  for (int r = radius; r >= 1; r /= 2, ++sample)
  {
    const auto choices = static_cast<std::uint32_t>(2 * r + 1);
    const int step =
        static_cast<int>(hashed(level_, sweep, static_cast<std::uint32_t>(seed), sample) % choices) - r;
    changed |= tryDisplacement(column, row, seed, displacement_[seed] + step);
  }
  return changed;
}

int LevelSearch::sweepOnce(int sweep, int radius)
{
  const bool forward = sweep % 2 == 0;
  int changes = 0;
  for (int i = 0; i < rowCount(); ++i)
  {
    const int row = forward ? i : rowCount() - 1 - i;
    for (int j = 0; j < columnCount(); ++j)
    {
      const int column = forward ? j : columnCount() - 1 - j;
      const std::size_t seed = seedIndex(column, row);
      const bool propagated = propagate(column, row, seed, forward ? 1 : -1);
      const bool found = searchAround(column, row, seed, radius, static_cast<std::uint32_t>(sweep + 1));
      changes += propagated || found ? 1 : 0;
    }
  }
  return changes;
}

void LevelSearch::search(int sweeps, int radius)
{
  const double settled = SETTLED_FRACTION * static_cast<double>(seedCount());
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    if (sweepOnce(sweep, radius) < settled)
    {
      return;
    }
  }
}

/// Where the two lines of equal slope through the three costs around the minimum meet; the sum of absolute
/// differences has such a kink, and a parabola would be biased towards whole pixels.
float subpixelOffset(int before, int middle, int after)
{
  const int steeper = std::max(before, after) - middle;
  if (before >= OUTSIDE || after >= OUTSIDE || before < middle || after < middle || steeper <= 0)
  {
    return 0.0F;
  }
  return 0.5F * static_cast<float>(before - after) / static_cast<float>(steeper);
}

SeedMatches LevelSearch::matches(bool subpixel) const
{
  SeedMatches result;
  result.columns_px = columns_.positions_px;
  result.rows_px = rows_.positions_px;
  result.disparity.create(rowCount(), columnCount(), CV_32FC1);
  result.cost.create(rowCount(), columnCount(), CV_32FC1);
  result.centre_share.create(rowCount(), columnCount(), CV_32FC1);
  for (int row = 0; row < rowCount(); ++row)
  {
    for (int column = 0; column < columnCount(); ++column)
    {
      const std::size_t seed = seedIndex(column, row);
      const int displacement = displacement_[seed];
      const int middle = cost_[seed];
      const int before = costAt(column, row, displacement - 1);
      const int after = costAt(column, row, displacement + 1);
      const float offset = subpixel ? subpixelOffset(before, middle, after) : 0.0F;
      const bool undecided = before == middle && after == middle;
      result.disparity.at<float>(row, column) = line_.disparity(static_cast<float>(displacement) + offset);
      result.cost.at<float>(row, column) = static_cast<float>(middle);
      result.centre_share.at<float>(row, column) =
          undecided ? 0.0F : from_->centreShare().at<float>(pixelOf(column, row));
    }
  }
  return result;
}

}  // namespace

SeedMatches matchPair(const std::vector<DescriptorImage>& from, const std::vector<DescriptorImage>& to,
                      const ViewPair& pair, const std::optional<DisparityRange>& range,
                      const PatchMatchOptions& options)
{
  const cv::Size size = from.front().size();
  const std::vector<int> columns = finestSeeds(size.width, options.grid_spacing_px);
  const std::vector<int> rows = finestSeeds(size.height, options.grid_spacing_px);
  const auto searchOn = [&](std::size_t level)
  {
    const double scale = std::pow(options.pyramid_ratio, static_cast<double>(level));
    const cv::Size level_size = from[level].size();
    return LevelSearch(from[level], to[level],
                       EpipolarLine(pair, scale, level_size, range, options.max_displacement_px),
                       seedAxis(columns, scale, level_size.width), seedAxis(rows, scale, level_size.height),
                       static_cast<std::uint32_t>(level));
  };
  LevelSearch search = searchOn(from.size() - 1);
  search.initialiseAtRandom();
  search.search(options.iterations, options.search_radius_px);
  for (std::size_t level = from.size() - 1; level-- > 0;)
  {
    LevelSearch finer = searchOn(level);
    finer.initialiseFrom(search, options.pyramid_ratio);
    finer.search(options.iterations, options.search_radius_px);
    search = std::move(finer);
  }
  return search.matches(options.subpixel);
}

}  // namespace light_field_depth
