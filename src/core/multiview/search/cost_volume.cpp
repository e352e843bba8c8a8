#include "core/multiview/search/cost_volume.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/multiview/search/cost_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// Rows of tiles of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int TILE_ROWS_PER_CHUNK = 2;
/// Above every cost, which FULL_COST limits.
constexpr std::uint8_t NO_COST = 255;
/// Labels by which a surface must be nearer to hide a point.
constexpr int HIDDEN_MARGIN_LABELS = 2;

/// Half of the arms, as a number that the kernel can average.
int bestArms(std::size_t arms)
{
  constexpr std::size_t few = 2;
  constexpr std::size_t many = 7;
  if (arms <= few)
  {
    return 1;
  }
  return arms < many ? 2 : 4;
}

std::vector<std::uint16_t> armScales(const ViewSet& views, int truncation)
{
  constexpr double fixed_point = 256.0;
  std::vector<std::uint16_t> scales;
  for (const Arm& arm : views.arms)
  {
    const double full = static_cast<double>(truncation) * (arm.last - arm.first);
    scales.push_back(static_cast<std::uint16_t>(std::lround(FULL_COST * fixed_point / full)));
  }
  return scales;
}

}  // namespace

void CostVolume::create(int new_width, int new_height, const LabelBands& new_bands, Capacity capacity)
{
  width = new_width;
  height = new_height;
  bands = new_bands;
  offsets.assign(1, 0);
  for (int row = 0; row < bands.rows(); ++row)
  {
    for (int column = 0; column < bands.columns(); ++column)
    {
      const int labels = capacity == Capacity::AllLabels ? bands.labels() : bands.at(row, column).count;
      offsets.push_back(offsets.back() + static_cast<std::size_t>(labels) * TILE_PX * TILE_PX);
    }
  }
  values.resize(size());
}

std::size_t CostVolume::largestRow() const
{
  std::size_t largest = 0;
  for (int row = 0; row < bands.rows(); ++row)
  {
    largest = std::max(largest, tileOffset(row, bands.columns()) - tileOffset(row, 0));
  }
  return largest;
}

/// Neighbouring tiles first .. end - 1 of a row of tiles that try a label.
struct TileRun
{
  int label = 0;
  int first = 0;
  int end = 0;
};

/// Memory of one chunk of rows at work.
struct CostVolumeBuilder::Scratch
{
  std::vector<TileRun> runs;                  // of the present row of tiles
  std::vector<SampleRows> samples;            // one a view
  std::vector<const std::uint8_t*> pointers;  // one a view, for one label
  std::vector<const std::uint8_t*> surfaces;
  std::vector<const std::uint8_t*> shifted_pointers;  // where a run of tiles begins
  std::vector<const std::uint8_t*> shifted_surfaces;
  std::vector<const std::uint8_t*> shifted_masked;
  std::vector<const std::uint8_t*> masked;  // one a view, for one label; null where there is no mask
  std::vector<std::uint8_t> cost;           // of one label in one row
  std::vector<std::uint8_t> inside;         // least cost of the labels in the band, of an observed row
  std::vector<std::uint8_t> outside;        // of the others
};

/// What to fill a volume with.
struct CostVolumeBuilder::Task
{
  const ViewSet& views;
  const LabelSpace& labels;
  const CostSettings& settings;
  const VisibleSurfaces* surfaces = nullptr;        ///< nullptr: from the arms
  const std::vector<std::uint8_t>* only = nullptr;  ///< tiles to fill; nullptr: all
  RowObserver* observer = nullptr;
  bool masked = views.hasMasks();
};

CostVolumeBuilder::CostVolumeBuilder() = default;
CostVolumeBuilder::~CostVolumeBuilder() = default;

void CostVolumeBuilder::buildFromArms(const ViewSet& views, const LabelSpace& labels, const LabelBands& bands,
                                      const CostSettings& settings, ThreadPool& pool, CostVolume& volume)
{
  volume.create(views.width(), views.height(), bands, CostVolume::Capacity::Band);
  build({views, labels, settings}, pool, volume);
}

void CostVolumeBuilder::buildObserved(const ViewSet& views, const LabelSpace& labels, const LabelBands& bands,
                                      const CostSettings& settings, RowObserver& observer, ThreadPool& pool,
                                      CostVolume& volume)
{
  volume.create(views.width(), views.height(), bands, CostVolume::Capacity::AllLabels);
  Task task{views, labels, settings};
  task.observer = &observer;
  build(task, pool, volume);
}

void CostVolumeBuilder::rebuildTiles(const ViewSet& views, const LabelSpace& labels, const LabelBands& bands,
                                     const std::vector<std::uint8_t>& tiles, const CostSettings& settings,
                                     ThreadPool& pool, CostVolume& volume)
{
  volume.bands = bands;
  Task task{views, labels, settings};
  task.only = &tiles;
  build(task, pool, volume);
}

void CostVolumeBuilder::buildFromVisible(const ViewSet& views, const LabelSpace& labels,
                                         const LabelBands& bands, const VisibleSurfaces& surfaces,
                                         const CostSettings& settings, ThreadPool& pool, CostVolume& volume)
{
  volume.create(views.width(), views.height(), bands, CostVolume::Capacity::Band);
  Task task{views, labels, settings};
  task.surfaces = &surfaces;
  build(task, pool, volume);
}

/// The rows of one chunk.
struct CostVolumeBuilder::RowJob
{
  const Task& task;
  const std::vector<std::uint16_t>& arm_scales;
  Scratch& scratch;
  CostVolume& volume;
  const ViewSet& views = task.views;
  const LabelSpace& labels = task.labels;
  const VisibleSurfaces* surfaces = task.surfaces;
  const CostSettings& settings = task.settings;

  void begin() const
  {
    const auto count = views.views.size();
    scratch.samples.resize(count);
    scratch.pointers.resize(count);
    scratch.surfaces.resize(count);
    scratch.masked.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      scratch.samples[i].reset(views.views[i], labels);
    }
    scratch.cost.resize(static_cast<std::size_t>(volume.bands.columns()) * TILE_PX + VECTOR_OVERRUN);
  }

  /// The rows of a row of tiles one after the other.
  void run(int y) const
  {
    if (y % TILE_PX == 0)
    {
      findRuns(y / TILE_PX);
    }
    if (task.observer != nullptr && task.observer->wants(y))
    {
      runObserved(y);
      return;
    }
    int sampled = -1;  // label
    for (const TileRun& run : scratch.runs)
    {
      if (run.label != sampled)
      {
        sample(run.label, y);
        sampled = run.label;
      }
      computeCost(run.label, y, run.first, run.end);
      for (int tile = run.first; tile < run.end; ++tile)
      {
        store(run.label, y, tile,
              scratch.cost.data() + static_cast<std::ptrdiff_t>(tile - run.first) * TILE_PX);
      }
    }
  }

private:
  void findRuns(int row) const
  {
    const int columns = volume.bands.columns();
    scratch.runs.clear();
    for (int label = 0; label < labels.count; ++label)
    {
      for (int first = 0; first < columns; ++first)
      {
        int end = first;
        while (end < columns && isWanted(row, end, label))
        {
          ++end;
        }
        if (end > first)
        {
          scratch.runs.push_back({label, first, end});
          first = end;  // which does not try it
        }
      }
    }
  }

  void sample(int label, int y) const
  {
    for (std::size_t i = 0; i < scratch.samples.size(); ++i)
    {
      scratch.pointers[i] = scratch.samples[i].row(label, y);
    }
    if (surfaces == nullptr && !task.masked)
    {
      return;
    }
    for (std::size_t i = 0; i < scratch.samples.size(); ++i)
    {
      const PreparedView& view = views.views[i];
      const LabelShift& shift = scratch.samples[i].shift(label);
      const int row = y + shift.nearest_dy;
      if (surfaces != nullptr)
      {
        scratch.surfaces[i] = surfaces->row(static_cast<int>(i), row) + shift.nearest_dx;
      }
      scratch.masked[i] = view.masked.width() > 0 ? view.masked.row(row) + shift.nearest_dx : nullptr;
    }
  }

  bool isWanted(int row, int column, int label) const
  {
    const auto tile = static_cast<std::size_t>(row) * static_cast<std::size_t>(volume.bands.columns()) +
                      static_cast<std::size_t>(column);
    return volume.bands.at(row, column).contains(label) && (task.only == nullptr || (*task.only)[tile] != 0);
  }

  /// All labels in all tiles, of which those in the bands are stored.
  void runObserved(int y) const
  {
    const int columns = volume.bands.columns();
    const auto width = static_cast<std::size_t>(columns) * TILE_PX;
    scratch.inside.assign(width, NO_COST);
    scratch.outside.assign(width, NO_COST);
    for (int label = 0; label < labels.count; ++label)
    {
      sample(label, y);
      computeCost(label, y, 0, columns);
      for (int column = 0; column < columns; ++column)
      {
        const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(column) * TILE_PX;
        const bool inside = volume.bands.at(y / TILE_PX, column).contains(label);
        std::uint8_t* const least = (inside ? scratch.inside : scratch.outside).data() + first;
        const std::uint8_t* const cost = scratch.cost.data() + first;
        for (int i = 0; i < TILE_PX; ++i)
        {
          least[i] = std::min(least[i], cost[i]);
        }
        if (inside)
        {
          store(label, y, column, cost);
        }
      }
    }
    task.observer->observe(y, scratch.inside.data(), scratch.outside.data(), views.width());
  }

  /// One label in neighbouring tiles, from the beginning of scratch.cost.
  void computeCost(int label, int y, int first_column, int end_column) const
  {
    const int first_x = first_column * TILE_PX;
    const int width = std::min(end_column * TILE_PX, views.width()) - first_x;
    if (surfaces == nullptr)
    {
      armCost(y, first_x, width);
    }
    else
    {
      visibleCost(label, y, first_x, width);
    }
  }

  void store(int label, int y, int column, const std::uint8_t* cost) const
  {
    const LabelBand& band = volume.bands.at(y / TILE_PX, column);
    const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(y % TILE_PX) * band.count + label - band.first;
    std::copy_n(cost, TILE_PX,
                volume.values.data() + volume.tileOffset(y / TILE_PX, column) + line * TILE_PX);
  }

  static const std::uint8_t* const* shifted(const std::vector<const std::uint8_t*>& rows, int first_x,
                                            std::vector<const std::uint8_t*>& result)
  {
    result.resize(rows.size());
    std::transform(rows.begin(), rows.end(), result.begin(),
                   [first_x](const std::uint8_t* row) { return row + first_x; });
    return result.data();
  }

  void armCost(int y, int first_x, int width) const
  {
    ArmCostRow row;
    row.reference = views.reference.row(y) + first_x;
    row.reference_stride = views.reference.channelStride();
    row.samples = shifted(scratch.pointers, first_x, scratch.shifted_pointers);
    row.sample_stride = scratch.samples.front().channelStride();
    row.channels = views.reference.channels();
    row.width = width;
    row.truncation = settings.truncation;
    row.arms = views.arms.data();
    row.arm_count = static_cast<int>(views.arms.size());
    row.best_arms = bestArms(views.arms.size());
    row.arm_scales = arm_scales.data();
    armCostRow(row, scratch.cost.data());
    if (task.masked)
    {
      maskArmCosts(row, rowMasks(y, first_x), scratch.cost.data());
    }
  }

  RowMasks rowMasks(int y, int first_x) const
  {
    scratch.shifted_masked.resize(scratch.masked.size());
    std::transform(scratch.masked.begin(), scratch.masked.end(), scratch.shifted_masked.begin(),
                   [first_x](const std::uint8_t* masked)
                   { return masked == nullptr ? nullptr : masked + first_x; });
    RowMasks masks;
    masks.reference = referenceMasked(y, first_x);
    masks.views = scratch.shifted_masked.data();
    masks.view_count = static_cast<int>(scratch.shifted_masked.size());
    return masks;
  }

  const std::uint8_t* referenceMasked(int y, int first_x) const
  {
    const PlanarImage& masked = views.reference_masked;
    return masked.width() > 0 ? masked.row(y) + first_x : nullptr;
  }

  void visibleCost(int label, int y, int first_x, int width) const
  {
    VisibleCostRow row;
    row.reference = views.reference.row(y) + first_x;
    row.reference_stride = views.reference.channelStride();
    row.samples = shifted(scratch.pointers, first_x, scratch.shifted_pointers);
    row.sample_stride = scratch.samples.front().channelStride();
    row.surfaces = shifted(scratch.surfaces, first_x, scratch.shifted_surfaces);
    row.views = static_cast<int>(scratch.samples.size());
    row.channels = views.reference.channels();
    row.width = width;
    row.truncation = settings.truncation;
    row.hidden_above = std::min(label + 1 + HIDDEN_MARGIN_LABELS, OUT_OF_FRAME - 1);
    row.min_seeing_views = settings.min_seeing_views;
    row.unseen_penalty = settings.unseen_penalty;
    visibleCostRow(row, scratch.cost.data());
    if (referenceMasked(y, first_x) != nullptr)
    {
      maskVisibleCosts(row, rowMasks(y, first_x), scratch.cost.data());
    }
  }
};

void CostVolumeBuilder::build(const Task& task, ThreadPool& pool, CostVolume& volume)
{
  const auto scales = armScales(task.views, task.settings.truncation);
  pool.parallelFor(0, volume.bands.rows(), TILE_ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     scratch_.use(
                         [&](Scratch& scratch)
                         {
                           const RowJob job{task, scales, scratch, volume};
                           job.begin();
                           for (int y = first * TILE_PX; y < std::min(last * TILE_PX, volume.height); ++y)
                           {
                             job.run(y);
                           }
                         });
                   });
}

}  // namespace light_field_depth::multiview
