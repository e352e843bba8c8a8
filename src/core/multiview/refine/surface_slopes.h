#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_SURFACE_SLOPES_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_SURFACE_SLOPES_H

#include <vector>

#include <opencv2/core.hpp>

#include "core/multiview/refine/cell_sums.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::multiview
{
struct SlopeSettings
{
  int reach_px = 12;  ///< of each of two boxes, one after the other, over which changes are averaged
  /// Weight of the data (curvature a pixel) from which on a change counts in full.
  float full_weight = 20.0F;
  /// Changes above it from pixel to pixel are steps, not slopes. A half of it takes the floor of antinous for
  /// a step; 0.12 is as good.
  float soft_px = 0.08F;
  /// How much a level surface is believed, in parts of a change that is known: surfaces go on with the slope
  /// that is known near them. With 0.05 a blank wall is filled level and 13 % of the bundled scene is off by
  /// 0.07 px and more; with 0.002 it is 11 %, and 0.0005 changes little.
  float level_share = 0.002F;
};

/// How the disparity changes from pixel to pixel along surfaces: the robust mean of the changes that data
/// confirm, on cells of CELL_PX. Keeps its memory; one call at a time.
class SurfaceSlopes
{
public:
  /// @param disparity, weight CV_32FC1
  /// @param guide_left, guide_above CV_32FC1, links by the image alone, 0 in the first column and row
  void find(const cv::Mat& disparity, const cv::Mat& weight, const cv::Mat& guide_left,
            const cv::Mat& guide_above, const SlopeSettings& settings, ThreadPool& pool);

  /// Change from (x - 1, y) to (x, y), px; [width + 1].
  const float* left(int y) const { return left_.slopes.ptr<float>(y / CELL_PX); }
  /// Change from (x, y - 1) to (x, y), px; [width + 1].
  const float* above(int y) const { return above_.slopes.ptr<float>(y / CELL_PX); }

private:
  struct Axis
  {
    cv::Mat changes;  // CV_32FC1, sums over cells
    cv::Mat shares;
    cv::Mat slopes;  // a row of cells, every pixel across
  };

  static void average(const SlopeSettings& settings, int width, ThreadPool& pool, Axis& axis);

  Axis left_;
  Axis above_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_REFINE_SURFACE_SLOPES_H
