#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_LABEL_SPACE_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_LABEL_SPACE_H

#include "light_field_depth/core/light_field.h"

namespace light_field_depth::multiview
{
/// The disparities that are tried: first + label * step, label 0..count - 1.
struct LabelSpace
{
  float first_px = 0.0F;
  float step_px = 0.125F;
  int count = 0;

  float disparity(float label) const { return first_px + label * step_px; }
  float label(float disparity_px) const { return (disparity_px - first_px) / step_px; }
  DisparityRange range() const { return {first_px, disparity(static_cast<float>(count - 1))}; }
};

/// Labels that cover a range. The disparities are multiples of the step, so that the views' displacements
/// repeat the same few fractions of a pixel. The step is made larger where more than `max_labels` would be
/// needed.
LabelSpace makeLabelSpace(const DisparityRange& range, float step_px, int max_labels);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SEARCH_LABEL_SPACE_H
