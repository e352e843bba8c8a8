#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_COST_VOLUME_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_COST_VOLUME_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/scratch_pool.h"
#include "core/light_field/view_set.h"
#include "core/multiview/search/label_bands.h"
#include "core/multiview/search/label_space.h"
#include "core/multiview/search/sample_rows.h"
#include "core/multiview/search/visibility.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Matching cost of every pixel and of the labels of its tile, 0..FULL_COST. A tile lies together, as
/// [y][label][x] with TILE_PX values of each; what stands out of the image has any value.
struct CostVolume
{
  int width = 0;
  int height = 0;
  LabelBands bands;
  std::vector<std::uint8_t> values;
  std::vector<std::size_t> offsets;  ///< where each tile begins, and the size

  /// How much room each tile has.
  enum class Capacity
  {
    AllLabels,  ///< its band may change later
    Band
  };

  /// Takes the bands. Keeps the memory when it suffices.
  void create(int width, int height, const LabelBands& bands, Capacity capacity);
  std::size_t size() const { return offsets.back(); }
  std::size_t tileOffset(int row, int column) const
  {
    return offsets[static_cast<std::size_t>(row) * static_cast<std::size_t>(bands.columns()) +
                   static_cast<std::size_t>(column)];
  }
  /// Of the values of one row of tiles.
  std::size_t largestRow() const;

  const LabelBand& bandAt(int x, int y) const { return bands.at(y / TILE_PX, x / TILE_PX); }
  /// Where the cost of a label of the pixel's band is; that of the next label is TILE_PX further.
  std::size_t index(int x, int y, int label) const
  {
    const LabelBand& band = bandAt(x, y);
    const int line = (y % TILE_PX) * band.count + label - band.first;
    return tileOffset(y / TILE_PX, x / TILE_PX) + static_cast<std::size_t>(line) * TILE_PX +
           static_cast<std::size_t>(x % TILE_PX);
  }
  std::uint8_t at(int x, int y, int label) const { return values[index(x, y, label)]; }
};

/// Where the costs come from.
struct CostSettings
{
  int truncation = 30;  ///< of one view's difference, summed over the channels
  /// Cost of a view that is missing to min_seeing_views. With less than the truncation, what no view can see
  /// would beat what several views see badly.
  int unseen_penalty = 30;
  int min_seeing_views = 3;
};

/// Is told how well all labels match in some rows, whatever the bands. The rows of one tile come from one
/// thread, those of others from other threads at the same time.
class RowObserver
{
public:
  virtual ~RowObserver() = default;
  virtual bool wants(int y) const = 0;
  /// @param inside, outside [width] the least cost of the labels in the pixel's band and of the others,
  ///   255 where there are none
  virtual void observe(int y, const std::uint8_t* inside, const std::uint8_t* outside, int width) = 0;
};

/// Fills cost volumes, in each tile the labels of its band. Keeps its scratch memory; one call at a time.
class CostVolumeBuilder
{
public:
  CostVolumeBuilder();
  ~CostVolumeBuilder();

  /// The mean of the best arms, so that a point that an occluder hides from some is not charged for them.
  void buildFromArms(const ViewSet& views, const LabelSpace& labels, const LabelBands& bands,
                     const CostSettings& settings, ThreadPool& pool, CostVolume& volume);

  /// The same, with an observer of some rows, and with room for all labels in each tile.
  void buildObserved(const ViewSet& views, const LabelSpace& labels, const LabelBands& bands,
                     const CostSettings& settings, RowObserver& observer, ThreadPool& pool,
                     CostVolume& volume);

  /// Some tiles of a volume from buildObserved() once more, with other bands there.
  /// @param tiles for each tile whether it is rebuilt; the bands of the others are as before
  void rebuildTiles(const ViewSet& views, const LabelSpace& labels, const LabelBands& bands,
                    const std::vector<std::uint8_t>& tiles, const CostSettings& settings, ThreadPool& pool,
                    CostVolume& volume);

  /// The mean over the views that see the point, given the surfaces that each view sees.
  void buildFromVisible(const ViewSet& views, const LabelSpace& labels, const LabelBands& bands,
                        const VisibleSurfaces& surfaces, const CostSettings& settings, ThreadPool& pool,
                        CostVolume& volume);

private:
  struct Scratch;
  struct Task;
  struct RowJob;
  void build(const Task& task, ThreadPool& pool, CostVolume& volume);

  ScratchPool<Scratch> scratch_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_COST_VOLUME_H
