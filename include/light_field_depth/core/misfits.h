#ifndef LIGHT_FIELD_DEPTH_CORE_MISFITS_H
#define LIGHT_FIELD_DEPTH_CORE_MISFITS_H

#include <vector>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// How far one view is from where its light field says it is. What should be seen at pixel p is seen at
///   p + shift_px + (zoom * q.x - roll * q.y, roll * q.x + zoom * q.y),   q = p - middle of the image.
struct ViewMisfit
{
  cv::Point2d shift_px;  ///< of the middle of the view
  double roll = 0.0;     ///< radians
  double zoom = 0.0;     ///< magnification minus 1
};

/// How well the views of a light field fit together.
struct Registration
{
  /// False: the light field can be used as it is; everything else is then neutral.
  bool differs = false;
  /// Disparities in the columns (by View::steps.y) are step_ratio * d + step_offset_px where those in the
  /// rows are d.
  double step_ratio = 1.0;
  double step_offset_px = 0.0;  ///< see step_ratio
  /// Disparities in the rows are so much more than those of the light field put right: nobody knows whether
  /// rows or columns are as they should be, so both move, by what moves all views least.
  double row_offset_px = 0.0;
  /// One for each view, what the line leaves; neutral for the reference. Empty: no view is off by itself.
  std::vector<ViewMisfit> views;
  /// Some view is rolled or zoomed so far that its image must be resampled.
  bool resample = false;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_MISFITS_H
