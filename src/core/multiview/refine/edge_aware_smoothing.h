#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_EDGE_AWARE_SMOOTHING_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_EDGE_AWARE_SMOOTHING_H

#include <array>
#include <vector>

#include <opencv2/core.hpp>

#include "core/base/scratch_pool.h"
#include "core/light_field/view_set.h"
#include "core/multiview/refine/coarse_correction.h"
#include "core/multiview/refine/line_solver.h"
#include "core/multiview/refine/surface_slopes.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
struct SmoothingSettings
{
  float strength = 200.0F;         ///< alpha, against the curvature of the data
  float image_edge_decay = 85.0F;  ///< kappa: links weaken by exp(-kappa * change of colour / 765)
  /// eps of one reweighting after the other: changes of the disparity above it are charged linearly. Wide at
  /// first, so that what is far from the minimum comes near it before steps are told from slopes. A third
  /// more of each costs cotton 0.02 % and antinous 0.1 % BadPix 0.03 (docs/experiments.md).
  std::array<float, 3> flat_px = {0.15F, 0.04F, 0.012F};
  /// From the second reweighting on surfaces go on with their slopes; else they are level.
  bool follow_slopes = false;
  SlopeSettings slopes;
};

/// Minimises  sum_p w_p (d_p - t_p)^2 + sum_pq s_pq(d) (d_p - d_q - m_pq)^2  over 4-neighbours by reweighted
/// least squares, m the slope of the surface (surface_slopes.h) or 0: for each reweighting the lines are
/// solved exactly, rows and columns in turn, then what is wrong over many pixels is corrected on coarser
/// grids, then the lines again. Keeps its memory; one call at a time.
class EdgeAwareSmoother
{
public:
  EdgeAwareSmoother();
  ~EdgeAwareSmoother();

  /// Computes the part of the links that the image decides.
  void setGuide(const PlanarImage& guide, const SmoothingSettings& settings, ThreadPool& pool);

  /// @param weight, target CV_32FC1  @param disparity CV_32FC1: start and result
  void run(const cv::Mat& weight, const cv::Mat& target, const SmoothingSettings& settings, ThreadPool& pool,
           cv::Mat& disparity);

private:
  struct Scratch;

  /// Of the rows first .. last - 1.
  void updateLinks(const cv::Mat& disparity, float flat_px, bool lean, int first, int last);
  void leanTargets(const cv::Mat& weight, const cv::Mat& target, ThreadPool& pool);

  cv::Mat guide_left_;   // link strength between (x - 1, y) and (x, y) from the image
  cv::Mat guide_above_;  // between (x, y - 1) and (x, y)
  cv::Mat link_left_;    // with the disparity's part; one more column, and 0 at both ends
  cv::Mat link_above_;   // one more row, and 0 in the first and the last
  SurfaceSlopes slopes_;
  cv::Mat leaning_;           // targets that make the slopes cost nothing
  std::vector<float> level_;  // no slope
  LineSolver lines_;
  CoarseCorrection coarse_;
  ScratchPool<Scratch> scratch_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_EDGE_AWARE_SMOOTHING_H
