#ifndef LIGHT_FIELD_DEPTH_CORE_REGISTRATION_H
#define LIGHT_FIELD_DEPTH_CORE_REGISTRATION_H

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/misfits.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
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

/// The same without the views of which no misfit is known where others have one.
LightField registeredViews(const LightField& light_field, const Registration& registration, ThreadPool& pool);

/// One whole sentence, with numbers, for each thing that is off; for arrays whose calibration should be
/// better.
std::vector<std::string> describe(const Registration& registration, const LightField& light_field);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_REGISTRATION_H
