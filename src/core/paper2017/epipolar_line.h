#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_EPIPOLAR_LINE_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_EPIPOLAR_LINE_H

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "core/paper2017/angular_volume.h"
#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// The whole-pixel displacements on the epipolar line of a pair of views, counted along the image axis that
/// is nearer to the line. On calibrated arrays, whose lines are slightly oblique, the other coordinate is
/// rounded.
class EpipolarLine
{
public:
  /// @param scale of the pyramid level, 1 at full size @param size of the level
  EpipolarLine(const ViewPair& pair, double scale, const cv::Size& size,
               const std::optional<DisparityRange>& range, double max_displacement_px);

  int min() const { return min_; }
  int max() const { return max_; }

  /// @param displacement between min() - 1 and max() + 1
  cv::Point target(const cv::Point& from, int displacement) const
  {
    const int index = displacement - min_ + 1;
    return from + targets_[static_cast<std::size_t>(index)];
  }

  /// In pixels per grid step of the full size.
  float disparity(float displacement) const { return static_cast<float>((offset_ - displacement) / steps_); }

private:
  double steps_;   ///< along the axis, in pixels of the level per pixel of disparity
  double offset_;  ///< along the axis, in pixels of the level
  int min_ = 0;
  int max_ = 0;
  std::vector<cv::Point> targets_;  ///< from min_ - 1 to max_ + 1
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_EPIPOLAR_LINE_H
