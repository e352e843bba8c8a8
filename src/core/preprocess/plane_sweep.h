#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_PLANE_SWEEP_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_PLANE_SWEEP_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// A view as the plane sweep wants it: the reference's pixel p of disparity d is at p - d * steps + offset.
struct SweepView
{
  cv::Mat image;       ///< CV_8UC1, the size of the reference
  cv::Point2f steps;   ///< in pixels of `image` for a disparity of 1
  cv::Point2f offset;  ///< in pixels of `image`
};

/// Views on one side of the reference: what hides a point from one of them hides it from the others, too.
using SweepArm = std::vector<SweepView>;

/// What is compared with what, and at which disparities.
struct PlaneSweep
{
  cv::Mat reference;           ///< CV_8UC1
  std::vector<SweepArm> arms;  ///< 1 to 4, none of them empty, at most 6 views each
  float first_disparity = 0.0F;
  float disparity_step = 1.0F;
  int labels = 0;

  float disparity(float label) const { return first_disparity + label * disparity_step; }
};

/// Matching costs: cost(label)[y * width + x] in sixteenths of a grey level, the mean over a window and over
/// the arms but the worst.
struct SweepCosts
{
  int labels = 0;
  cv::Size size;
  cv::Mat values;  ///< CV_16UC1, a row for each label

  std::size_t area() const { return static_cast<std::size_t>(size.area()); }
  const std::uint16_t* cost(int label) const { return values.ptr<std::uint16_t>(label); }
  std::uint16_t* cost(int label) { return values.ptr<std::uint16_t>(label); }
};

/// Cost of a grey difference at or above which nothing is learnt, in grey levels. It is also the cost of
/// falling outside a view.
constexpr std::uint8_t SWEEP_TRUNCATION = 40;
/// Sixteen bits hold SWEEP_TRUNCATION times this, with room for sums.
constexpr int SWEEP_COST_PER_GREY_LEVEL = 16;

/// Mean truncated absolute difference over 5 x 5 pixels, the views of an arm and the arms but the worst, so
/// that points hidden on one side still match.
SweepCosts sweepPlanes(const PlaneSweep& sweep, ThreadPool& pool);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_PLANE_SWEEP_H
