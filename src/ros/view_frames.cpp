#include "ros/view_frames.h"

#include <cstddef>
#include <utility>

namespace light_field_depth
{
std::vector<geometry_msgs::TransformStamped> viewFrames(const LightField& light_field,
                                                        const std::vector<std::string>& image_frames,
                                                        const std::string& reference_frame)
{
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    if (i == light_field.reference_index)
    {
      continue;
    }
    const View& view = light_field.views[i];
    const bool has_own_frame = !image_frames[i].empty() && image_frames[i] != reference_frame &&
                               image_frames[i] != image_frames[light_field.reference_index];
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = reference_frame;
    transform.child_frame_id = has_own_frame ? image_frames[i]
                                             : reference_frame + "_view_" + std::to_string(view.grid.row) +
                                                   "_" + std::to_string(view.grid.column);
    transform.transform.translation.x = view.steps.x * light_field.calibration->baseline_m;
    transform.transform.translation.y = view.steps.y * light_field.calibration->baseline_m;
    transform.transform.rotation.w = 1.0;
    transforms.push_back(std::move(transform));
  }
  return transforms;
}

}  // namespace light_field_depth
