#include "core/multiview/search/path_aggregation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/light_field/pixel_kernels.h"
#include "core/multiview/search/path_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;

/// The states of TILE_PX paths on their way through tiles with different bands.
class PathState
{
public:
  /// Room for the labels 0..labels - 1 and one more on either side.
  void begin(int labels)
  {
    values_.assign(static_cast<std::size_t>(labels + 2) * TILE_PX, 0);
    minima_.fill(0);
    band_ = {0, labels};
    fill(-1, 0);
    fill(labels, labels + 1);
  }

  /// Labels that the last tile did not try have no state in the next one.
  void enter(const LabelBand& band)
  {
    fill(band.first - 1, std::min(band_.first, band.end() + 1));
    fill(std::max(band_.end(), band.first - 1), band.end() + 1);
    fill(band.first - 1, band.first);
    fill(band.end(), band.end() + 1);
    band_ = band;
  }

  std::uint16_t* values() { return at(band_.first); }
  std::uint16_t* minima() { return minima_.data(); }

private:
  std::uint16_t* at(int label) { return values_.data() + static_cast<std::ptrdiff_t>(label + 1) * TILE_PX; }
  void fill(int first, int end)
  {
    if (first < end)
    {
      std::fill(at(first), at(end), NO_STATE);
    }
  }

  std::vector<std::uint16_t> values_;
  std::array<std::uint16_t, TILE_PX> minima_{};
  LabelBand band_;
};

}  // namespace

/// Memory of one strip or column of tiles at work.
struct PathAggregator::Scratch
{
  PathState state;
  std::vector<std::uint8_t> cost;    // the tiles of a strip, transposed
  std::vector<std::uint16_t> sums;   // of the first path: the tiles of a strip, transposed, or of a column
  std::vector<std::uint8_t> packed;  // of a tile of a strip
  std::vector<std::uint16_t> steps;  // [x][TILE_PX]
  std::vector<std::uint16_t> line;   // sums of all paths
};

PathAggregator::PathAggregator() = default;
PathAggregator::~PathAggregator() = default;

void PathAggregator::setGuide(const PlanarImage& guide, const PathSettings& settings, ThreadPool& pool)
{
  // One tile more than the image on the right and below, so that whole tiles and the step after can be read.
  const auto padded = [](int size) { return static_cast<std::size_t>(size / TILE_PX + 2) * TILE_PX; };
  step_stride_ = padded(guide.width());
  step_left_.resize(step_stride_ * padded(guide.height()));
  step_above_.resize(step_left_.size());
  StepRow steps;
  steps.large_change_penalty = static_cast<float>(settings.large_change_penalty);
  steps.min_large_change_penalty = LARGE_CHANGE_FLOOR * static_cast<float>(settings.small_change_penalty);
  steps.width = guide.width();
  const auto setRow = [&](int y, StepRow row)
  {
    const std::size_t offset = static_cast<std::size_t>(y) * step_stride_;
    std::uint16_t* const left = step_left_.data() + offset;
    std::uint16_t* const above = step_above_.data() + offset;
    colourChanges({guide.row(y), guide.row(y - 1), guide.channelStride(), guide.channels(), guide.width()},
                  left, above);
    for (std::uint16_t* const row_of_steps : {left, above})
    {
      row.steps = row_of_steps;
      stepRow(row);
    }
  };
  pool.parallelFor(0, guide.height(), ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       setRow(y, steps);
                     }
                   });
}

/// Both horizontal paths over TILE_PX rows.
class PathAggregator::Strip
{
public:
  Strip(PathAggregator& aggregator, const CostVolume& volume, const PathSettings& settings, int row,
        Scratch& scratch)
      : aggregator_(aggregator), volume_(volume), scratch_(scratch), row_(row),
        small_change_penalty_(static_cast<std::uint16_t>(settings.small_change_penalty))
  {
    const auto columns = static_cast<std::size_t>(volume.bands.columns());
    const std::size_t values = volume.largestRow();
    scratch.cost.resize(values);
    scratch.sums.resize(values);
    scratch.packed.resize(static_cast<std::size_t>(volume.bands.labels()) * TILE_PX * TILE_PX);
    scratch.steps.resize((columns + 1) * TILE_PX * TILE_PX);
    for (std::size_t column = 0; column <= columns; ++column)
    {
      transposeSteps(column);
    }
  }

  void run()
  {
    const int columns = volume_.bands.columns();
    scratch_.state.begin(volume_.bands.labels());
    for (int column = 0; column < columns; ++column)
    {
      const LabelBand& band = volume_.bands.at(row_, column);
      transposeTile(volume_.values.data() + volume_.tileOffset(row_, column), band.count, cost(column));
      walkTile(enter(column, false), sums(column));
    }
    scratch_.state.begin(volume_.bands.labels());
    for (int column = columns - 1; column >= 0; --column)
    {
      walkBackTile(enter(column, true), sums(column), scratch_.packed.data());
      transposeTile(scratch_.packed.data(), volume_.bands.at(row_, column).count,
                    aggregator_.packed_.data() + volume_.tileOffset(row_, column));
    }
  }

private:
  std::size_t offset(int column) const
  {
    return volume_.tileOffset(row_, column) - volume_.tileOffset(row_, 0);
  }
  std::uint8_t* cost(int column) const { return scratch_.cost.data() + offset(column); }
  std::uint16_t* sums(int column) const { return scratch_.sums.data() + offset(column); }

  void transposeSteps(std::size_t column) const
  {
    std::array<std::uint16_t, static_cast<std::size_t>(TILE_PX) * TILE_PX> block{};
    for (std::size_t y = 0; y < TILE_PX; ++y)
    {
      const std::size_t row = static_cast<std::size_t>(row_) * TILE_PX + y;
      std::copy_n(aggregator_.step_left_.data() + row * aggregator_.step_stride_ + column * TILE_PX, TILE_PX,
                  block.data() + y * TILE_PX);
    }
    transposeTile(block.data(), 1, scratch_.steps.data() + column * TILE_PX * TILE_PX);
  }

  PathTile enter(int column, bool backward) const
  {
    const LabelBand& band = volume_.bands.at(row_, column);
    scratch_.state.enter(band);
    PathTile tile;
    tile.cost = cost(column);
    tile.labels = band.count;
    tile.lines = std::min(TILE_PX, volume_.width - column * TILE_PX);
    tile.backward = backward;
    tile.small_change_penalty = small_change_penalty_;
    tile.large_change_penalty = scratch_.steps.data() +
                                static_cast<std::ptrdiff_t>(column) * TILE_PX * TILE_PX +
                                (backward ? TILE_PX : 0);
    tile.large_change_stride = TILE_PX;
    tile.state = scratch_.state.values();
    tile.minima = scratch_.state.minima();
    return tile;
  }

  PathAggregator& aggregator_;
  const CostVolume& volume_;
  Scratch& scratch_;
  int row_;
  std::uint16_t small_change_penalty_;
};

/// Both vertical paths over TILE_PX columns, and the best labels.
class PathAggregator::Column
{
public:
  Column(PathAggregator& aggregator, const CostVolume& volume, const PathSettings& settings, int column,
         Scratch& scratch, cv::Mat& label)
      : aggregator_(aggregator), volume_(volume), scratch_(scratch), label_(label), column_(column),
        small_change_penalty_(static_cast<std::uint16_t>(settings.small_change_penalty))
  {
    std::size_t values = 0;
    for (int row = 0; row < volume.bands.rows(); ++row)
    {
      values += sizeOf(row);
    }
    scratch.sums.resize(std::max(scratch.sums.size(), values));
    scratch.line.resize(static_cast<std::size_t>(volume.bands.labels()) * TILE_PX);
  }

  void run()
  {
    const int rows = volume_.bands.rows();
    scratch_.state.begin(volume_.bands.labels());
    std::uint16_t* sums = scratch_.sums.data();
    for (int row = 0; row < rows; ++row)
    {
      walkTile(enter(row, false), sums);
      sums += sizeOf(row);
    }
    scratch_.state.begin(volume_.bands.labels());
    for (int row = rows - 1; row >= 0; --row)
    {
      sums -= sizeOf(row);
      select(row, sums);
    }
  }

private:
  int linesOf(int row) const { return std::min(TILE_PX, volume_.height - row * TILE_PX); }
  /// Of the tile in a row.
  std::size_t sizeOf(int row) const
  {
    return static_cast<std::size_t>(volume_.bands.at(row, column_).count) * TILE_PX * TILE_PX;
  }

  PathTile enter(int row, bool backward) const
  {
    const LabelBand& band = volume_.bands.at(row, column_);
    scratch_.state.enter(band);
    PathTile tile;
    tile.cost = volume_.values.data() + volume_.tileOffset(row, column_);
    tile.labels = band.count;
    tile.lines = linesOf(row);
    tile.backward = backward;
    tile.small_change_penalty = small_change_penalty_;
    const std::size_t step_row = static_cast<std::size_t>(row) * TILE_PX + (backward ? 1 : 0);
    tile.large_change_penalty = aggregator_.step_above_.data() + step_row * aggregator_.step_stride_ +
                                static_cast<std::size_t>(column_) * TILE_PX;
    tile.large_change_stride = static_cast<std::ptrdiff_t>(aggregator_.step_stride_);
    tile.state = scratch_.state.values();
    tile.minima = scratch_.state.minima();
    return tile;
  }

  void select(int row, const std::uint16_t* sums) const
  {
    std::array<float, static_cast<std::size_t>(TILE_PX) * TILE_PX> best{};
    const std::uint8_t* const across = aggregator_.packed_.data() + volume_.tileOffset(row, column_);
    selectFromTile(enter(row, true), sums, across, volume_.bands.at(row, column_).first, scratch_.line.data(),
                   best.data());
    const int width = std::min(TILE_PX, volume_.width - column_ * TILE_PX);
    for (int line = 0; line < linesOf(row); ++line)
    {
      std::copy_n(best.data() + static_cast<std::ptrdiff_t>(line) * TILE_PX, width,
                  label_.ptr<float>(row * TILE_PX + line) + column_ * TILE_PX);
    }
  }

  PathAggregator& aggregator_;
  const CostVolume& volume_;
  Scratch& scratch_;
  cv::Mat& label_;
  int column_;
  std::uint16_t small_change_penalty_;
};

void PathAggregator::aggregate(const CostVolume& volume, const PathSettings& settings, ThreadPool& pool,
                               cv::Mat& label)
{
  label.create(volume.height, volume.width, CV_32FC1);
  packed_.resize(volume.size());
  const auto each = [&](int count, const auto& body)
  {
    pool.parallelFor(0, count, 1,
                     [&](int first, int last)
                     {
                       scratch_.use(
                           [&](Scratch& scratch)
                           {
                             for (int i = first; i < last; ++i)
                             {
                               body(i, scratch);
                             }
                           });
                     });
  };
  each(volume.bands.rows(),
       [&](int row, Scratch& scratch) { Strip(*this, volume, settings, row, scratch).run(); });
  each(volume.bands.columns(),
       [&](int column, Scratch& scratch) { Column(*this, volume, settings, column, scratch, label).run(); });
}

}  // namespace light_field_depth::multiview
