#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_AXIS_SWEEP_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_AXIS_SWEEP_H

#include <cmath>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// The direction that the pixels of a view are supposed to move in.
enum class Axis
{
  X,
  Y
};

/// Displacements from -reach to +reach, in pixels of the reduced views.
struct Displacements
{
  float reach = 0.0F;
  float step = 1.0F;

  int count() const { return 2 * half() + 1; }
  int half() const { return static_cast<int>(std::lround(reach / step)); }
  float at(int label) const { return static_cast<float>(label - half()) * step; }
};

/// A view and what one unit of displacement is for it: +-1, or a little more or less where views stand
/// unevenly.
struct SweptView
{
  cv::Mat image;  ///< CV_32FC1
  float unit = 1.0F;
};

/// Side of the cells that the costs are averaged over before their window of 3 x 3 cells.
constexpr int CELL_SIDE_PX = 2;

/// How badly the views match the reference at every displacement along one axis: mean over the views that
/// see the pixel of min(|difference|, 1.5), averaged over windows of 6 x 6 pixels.
/// @param views one or two, of the size of the reference; pixel p is looked for at p - displacement * unit
/// @return CV_32FC1, a row for each displacement, a column for each cell of CELL_SIDE_PX squared, row-major
cv::Mat sweepAxis(const cv::Mat& reference, const std::vector<SweptView>& views, Axis axis,
                  const Displacements& displacements, ThreadPool& pool);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_AXIS_SWEEP_H
