#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_PATH_AGGREGATION_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_PATH_AGGREGATION_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/base/scratch_pool.h"
#include "core/light_field/view_set.h"
#include "core/multiview/search/cost_volume.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// P2 never falls below this many P1.
constexpr float LARGE_CHANGE_FLOOR = 0.5F;

/// Smoothness along the paths, in the units of FULL_COST.
struct PathSettings
{
  int small_change_penalty = 30;    ///< P1, for a change by one label
  int large_change_penalty = 1200;  ///< P2 for larger changes where the image does not change at all
};

/// Adds up the costs along the paths from the left, right, top and bottom, each pair of opposite ones in
/// whole units (PACKED_UNIT, MAX_PACKED of path_kernels.h), and takes the best label. Keeps its memory; one
/// call at a time.
class PathAggregator
{
public:
  PathAggregator();
  ~PathAggregator();

  /// @param guide image whose edges lower P2: P2 = max(floor * P1, large_change_penalty / (1 + |change of
  /// colour|)); for
  ///   the following calls of aggregate()
  void setGuide(const PlanarImage& guide, const PathSettings& settings, ThreadPool& pool);

  /// @param volume of the size of the guide  @param label CV_32FC1, sub-label position
  void aggregate(const CostVolume& volume, const PathSettings& settings, ThreadPool& pool, cv::Mat& label);

  /// P2 between (x, y) and its left (upper) neighbour.
  std::uint16_t stepLeft(int x, int y) const { return step_left_[stepIndex(x, y)]; }
  std::uint16_t stepAbove(int x, int y) const { return step_above_[stepIndex(x, y)]; }

private:
  std::size_t stepIndex(int x, int y) const
  {
    return static_cast<std::size_t>(y) * step_stride_ + static_cast<std::size_t>(x);
  }
  struct Scratch;
  class Strip;
  class Column;

  std::vector<std::uint8_t> packed_;       // of both horizontal paths, as CostVolume::values
  std::size_t step_stride_ = 0;            // of a row of steps
  std::vector<std::uint16_t> step_left_;   // P2 between (x - 1, y) and (x, y)
  std::vector<std::uint16_t> step_above_;  // P2 between (x, y - 1) and (x, y)
  ScratchPool<Scratch> scratch_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_PATH_AGGREGATION_H
