#include "core/multiview/search/label_space.h"

#include <cmath>

namespace light_field_depth::multiview
{
LabelSpace makeLabelSpace(const DisparityRange& range, float step_px, int max_labels)
{
  LabelSpace labels;
  labels.step_px = step_px;
  for (;;)
  {
    const double first = std::floor(range.min / labels.step_px);
    const double last = std::ceil(range.max / labels.step_px);
    const double count = last - first + 1.0;
    if (count <= max_labels)
    {
      labels.count = static_cast<int>(count);
      labels.first_px = static_cast<float>(first * labels.step_px);
      return labels;
    }
    labels.step_px *= 2.0F;
  }
}

}  // namespace light_field_depth::multiview
