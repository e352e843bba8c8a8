#ifndef LIGHT_FIELD_DEPTH_CORE_REGISTRATION_H
#define LIGHT_FIELD_DEPTH_CORE_REGISTRATION_H

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

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
  /// One for each view, what the line leaves; neutral for the reference. Empty: no view is off by itself.
  std::vector<ViewMisfit> views;
  /// Some view is rolled or zoomed so far that its image must be resampled.
  bool resample = false;
};

/// When views count as not fitting. Displacements are of the light field's own pixels.
struct RegistrationOptions
{
  /// Root mean square over the views, above which shifts are corrected. Clean rendered scenes show up to
  /// 0.025 px, a model of cheap cameras 0.15 px.
  double min_shift_px = 0.05;
  /// The same for what roll and zoom make of the image, root mean square over its pixels. Clean scenes: 0.03
  /// px.
  double min_bend_px = 0.07;
  /// The most that the line between rows and columns differs from none within the range. Clean scenes: 0.03
  /// px.
  double min_line_px = 0.06;
  /// No view is expected farther off than this; standard deviation.
  double expected_px = 0.5;
  /// Side of a pixel of the views in pixels of the light field that they are reduced from.
  double pixel_size = 1.0;
};

/// What rectification left: unequal steps of rows and columns, and a shift, roll and zoom of each view, from
/// the images alone.
///
/// Points are matched in a plane sweep of reduced views; then their disparities and the views' misfits are
/// adjusted together, with the disparities eliminated, to the differences between the views. Only where these
/// seem to be off they are measured again at the resolution of the views given. What no image tells is taken
/// as it stands: the steps along rows are the unit, and the mean shift of the views of the row along their
/// steps is none.
/// @param light_field 8-bit views, made equal in exposure; reduced ones suffice
/// @param range of disparities, in the light field's unit
/// @return neutral (differs is false) where nothing is clearly off, where there are more than 32 views, or
/// where
///   too few points can be matched. Independent of the number of threads.
Registration estimateRegistration(const LightField& light_field, const DisparityRange& range,
                                  ThreadPool& pool, const RegistrationOptions& options = {});

/// The light field with every view where it really is: View::steps and View::offset_px are corrected; images
/// are new where they had to be resampled, and shared otherwise.
LightField correctRegistration(const LightField& light_field, const Registration& registration,
                               ThreadPool& pool);

/// One whole sentence, with numbers, for each thing that is off; for arrays whose calibration should be
/// better.
std::vector<std::string> describe(const Registration& registration, const LightField& light_field);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_REGISTRATION_H
