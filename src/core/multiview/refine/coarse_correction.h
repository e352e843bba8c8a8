#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_COARSE_CORRECTION_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_COARSE_CORRECTION_H

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "core/base/scratch_pool.h"
#include "core/multiview/refine/line_solver.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// What line sweeps would need hundreds of turns for: errors that are smooth over many pixels are corrected
/// on grids of half the side each, whose cells move as one (a multigrid cycle with constant prolongation; W.
/// Briggs and others, "A Multigrid Tutorial", 2000). Along the correction goes the step that lowers the
/// energy most, so that it never rises. Keeps its memory; one call at a time.
class CoarseCorrection
{
public:
  CoarseCorrection();
  ~CoarseCorrection();

  /// Adds the correction to grid.values; nothing if a side is not longer than SMALLEST_SIDE_PX.
  void correct(const LinkedGrid& grid, ThreadPool& pool);

  /// Of a grid that has a coarser one below it: so few cells are solved by sweeps alone.
  static constexpr int SMALLEST_SIDE_PX = 8;

private:
  struct Scratch;
  struct Level;

  void coarsen(const LinkedGrid& fine, Level& level, ThreadPool& pool);
  static void spread(const Level& level, float factor, ThreadPool& pool, cv::Mat& fine);
  float bestStep(Level& level, ThreadPool& pool);

  std::vector<std::unique_ptr<Level>> levels_;  ///< of half the side first
  ScratchPool<Scratch> scratch_;
  std::vector<double> gains_;    ///< of each chunk of rows
  std::vector<double> charges_;  ///< likewise
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_COARSE_CORRECTION_H
