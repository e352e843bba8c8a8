#ifndef LIGHT_FIELD_DEPTH_CORE_DISPARITY_RANGE_H
#define LIGHT_FIELD_DEPTH_CORE_DISPARITY_RANGE_H

#include <optional>
#include <string>
#include <vector>

#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// Settings of findDisparityRange(). The defaults hold for dense plenoptic views and for sparse arrays.
struct DisparityRangeOptions
{
  /// How far a point may move between the reference view and the view nearest to it, in pixels, as far as the
  /// search looks first; but never more than two fifths of the side along which the view moves, and a quarter
  /// of it towards the near side of a pair. Where what it finds reaches that bound, it looks further.
  float max_displacement_px = 48.0F;

  /// The range is widened on both sides by the larger of this fraction of its width and of pad_labels. Raise
  /// either if the nearest or farthest objects are cut off.
  float pad_fraction = 0.05F;

  /// In units of what the search resolves: one pixel of displacement in the farthest view for views of 512
  /// pixels, two for views of 1024.
  float pad_labels = 0.8F;

  /// The disparity of a point at infinity where the geometry is known, see Calibration::disparity_offset_px:
  /// nothing is farther. Left aside where the bulk of the pixels contradicts it.
  std::optional<float> farthest_px;
};

/// One whole sentence for each field that cannot be used.
std::vector<std::string> validate(const DisparityRangeOptions& options);

/// Finds the disparities that occur in the reference view, from the images alone.
///
/// The views are compared in two plane sweeps at reduced resolution: one over everything that
/// max_displacement_px allows, with the view nearest to the reference in each direction, and again with wider
/// bounds where it finds something at their ends; one over what that left, with the farther views, which also
/// measures the ends of the range. A disparity belongs to the range if a connected patch of pixels is
/// explained clearly better by it than by every disparity inside the range, so that repeated texture, noise
/// and surfaces without texture do not widen it. Where the reference has one other view beside it, pixels
/// count that both views match to each other, and patches near the bulk of the range.
///
/// @param light_field of any type; brightness may differ a little between views (see core/exposure.h)
/// @return in pixels per grid step, widened as the options say; a narrow range about zero where no pixel of
///   the reference view has texture. Does not depend on the number of threads.
/// @pre validate(options) is empty
DisparityRange findDisparityRange(const LightField& light_field, ThreadPool& pool,
                                  const DisparityRangeOptions& options = {});

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_DISPARITY_RANGE_H
