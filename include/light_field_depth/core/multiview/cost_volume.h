#ifndef LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_COST_VOLUME_H
#define LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_COST_VOLUME_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "light_field_depth/core/multiview/label_space.h"
#include "light_field_depth/core/multiview/sample_rows.h"
#include "light_field_depth/core/multiview/view_set.h"
#include "light_field_depth/core/multiview/visibility.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// Matching cost of every pixel and label, 0..FULL_COST; the labels of a pixel lie together.
struct CostVolume
{
  int width = 0;
  int height = 0;
  int labels = 0;
  int pitch = 0;         ///< bytes from pixel to pixel: labels rounded up; the rest is PADDING_COST
  int padded_width = 0;  ///< pixels of a row in memory
  std::vector<std::uint8_t> values;

  /// Keeps the memory when it suffices.
  void create(int width, int height, int labels);
  std::size_t rowOffset(int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(padded_width) *
           static_cast<std::size_t>(pitch);
  }
};

/// Where the costs come from.
struct CostSettings
{
  int truncation = 30;  ///< of one view's difference, summed over the channels
  /// Cost of a view that is missing to min_seeing_views. With less than the truncation, what no view can see
  /// would beat what several views see badly.
  int unseen_penalty = 30;
  int min_seeing_views = 3;
  int hidden_margin = 2;  ///< labels by which a surface must be nearer to hide a point
};

/// Fills cost volumes. Keeps its scratch memory; one call at a time.
class CostVolumeBuilder
{
public:
  CostVolumeBuilder();
  ~CostVolumeBuilder();

  /// The mean of the best arms, so that a point that an occluder hides from some is not charged for them.
  void buildFromArms(const ViewSet& views, const LabelSpace& labels, const CostSettings& settings,
                     ThreadPool& pool, CostVolume& volume);

  /// The mean over the views that see the point, given the surfaces that each view sees.
  void buildFromVisible(const ViewSet& views, const LabelSpace& labels, const VisibleSurfaces& surfaces,
                        const CostSettings& settings, ThreadPool& pool, CostVolume& volume);

private:
  struct Scratch;
  struct RowJob;
  void build(const ViewSet& views, const LabelSpace& labels, const VisibleSurfaces* surfaces,
             const CostSettings& settings, ThreadPool& pool, CostVolume& volume);
  std::unique_ptr<Scratch> takeScratch();
  void giveBack(std::unique_ptr<Scratch> scratch);

  std::mutex mutex_;
  std::vector<std::unique_ptr<Scratch>> free_scratch_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_COST_VOLUME_H
