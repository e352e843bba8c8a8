#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_LINE_SOLVER_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_LINE_SOLVER_H

#include <functional>
#include <vector>

#include <opencv2/core.hpp>

#include "core/base/scratch_pool.h"
#include "core/multiview/refine/smoothing_kernels.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
/// The minimum of  sum_p w_p (v_p - t_p)^2 + sum_pq s_pq (v_p - v_q)^2  over 4-neighbours. All CV_32FC1.
struct LinkedGrid
{
  const cv::Mat& weight;
  const cv::Mat& target;
  const cv::Mat& left;  ///< between (x - 1, y) and (x, y); one more column, and 0 at both ends
  const cv::Mat& up;    ///< between (x, y - 1) and (x, y); one more row, and 0 in the first and the last
  cv::Mat& values;      ///< start and result
};

/// Pointers to a row of the grid and to the values of the rows beside it.
SystemRow systemRow(const LinkedGrid& grid, int y);

/// Solves the lines of a grid exactly, each given those beside it. Keeps its memory; one call at a time.
class LineSolver
{
public:
  /// Rows in bands that are worked on while they are in the cache of a core.
  using PrepareBand = std::function<void(int first, int last)>;

  /// Every second row given those between them, then those. A band does both but for its last row, which
  /// waits for the first one of the next band.
  /// @param prepare called for the rows of each band, before any of them or of the row above them changes;
  /// may be empty
  void solveRows(const LinkedGrid& grid, const PrepareBand& prepare, ThreadPool& pool);

  /// All columns, given the columns beside them before the call.
  void solveColumns(const LinkedGrid& grid, ThreadPool& pool);

private:
  void solveEverySecond(const LinkedGrid& grid, int first, int last, int step);

  cv::Mat solution_;
  ScratchPool<std::vector<float>> scratch_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_LINE_SOLVER_H
