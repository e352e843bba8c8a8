#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_SOR_SOLVER_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_SOR_SOLVER_H

#include <opencv2/core.hpp>

#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// A symmetric linear system on the pixel grid, one unknown a pixel:
///   (data + sum of the links) u  -  sum over the four neighbours of link * u_neighbour  =  right_side
/// All matrices CV_32FC1 of one size.
struct GridSystem
{
  cv::Mat data;        ///< >= 0
  cv::Mat link_right;  ///< >= 0, to the pixel on the right; the last column is ignored
  cv::Mat link_below;  ///< >= 0, to the pixel below; the last row is ignored
  cv::Mat right_side;
};

/// Successive over-relaxation in red-black order: each half sweep reads one colour and writes the other, so
/// the result does not depend on the number of threads.
/// @param values start and result, CV_32FC1
void solveBySor(const GridSystem& system, int iterations, float omega, cv::Mat& values, ThreadPool& pool);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_SOR_SOLVER_H
