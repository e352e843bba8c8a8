#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_SEARCH_BOUNDS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_SEARCH_BOUNDS_H

#include <vector>

#include "core/preprocess/sweep_views.h"
#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// The disparities that a first plane sweep looks at, and how they grow when what it finds reaches their end.
///
/// Arrays begin with the same displacement either way. A pair of cameras stands far apart, nearly always
/// without shear: it begins with a quarter of the image towards the near side and hardly anything towards the
/// far one, where matches would be wrong.
class SearchBounds
{
public:
  /// @param max_displacement_px see DisparityRangeOptions
  /// @param label_step of the sweep
  SearchBounds(const std::vector<AxisArm>& arms, float max_displacement_px, float label_step);

  const DisparityRange& range() const { return range_; }

  /// Opens each side that the disparities found reach, in the end as far as views of this size can show
  /// anything.
  /// @return false if no side is opened
  bool widenFor(const DisparityRange& found, float label_step);

private:
  float widened(float most) const;

  DisparityRange range_;
  float usual_ = 0.0F;  ///< either way
  float limit_ = 0.0F;
};

/// Whether there is one view beside the reference.
bool isPair(const std::vector<AxisArm>& arms);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_SEARCH_BOUNDS_H
