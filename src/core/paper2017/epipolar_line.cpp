#include "core/paper2017/epipolar_line.h"

#include <algorithm>
#include <cmath>

namespace light_field_depth
{
EpipolarLine::EpipolarLine(const ViewPair& pair, double scale, const cv::Size& size,
                           const std::optional<DisparityRange>& range, double max_displacement_px)
{
  const bool along_x = std::abs(pair.steps.x) >= std::abs(pair.steps.y);
  const double cross_steps = scale * (along_x ? pair.steps.y : pair.steps.x);
  const double cross_offset = scale * (along_x ? pair.offset_px.y : pair.offset_px.x);
  steps_ = scale * (along_x ? pair.steps.x : pair.steps.y);
  offset_ = scale * (along_x ? pair.offset_px.x : pair.offset_px.y);

  const double at_one_end = offset_ - steps_ * (range ? range->min : -max_displacement_px);
  const double at_other_end = offset_ - steps_ * (range ? range->max : max_displacement_px);
  const int longest = (along_x ? size.width : size.height) - 1;
  const auto inside = [longest](double displacement)
  { return static_cast<int>(std::clamp(displacement, -1.0 * longest, 1.0 * longest)); };
  min_ = inside(std::floor(std::min(at_one_end, at_other_end)));
  max_ = inside(std::ceil(std::max(at_one_end, at_other_end)));
  for (int displacement = min_ - 1; displacement <= max_ + 1; ++displacement)
  {
    const double disparity_px = (offset_ - displacement) / steps_;
    const int across = cvRound(cross_offset - disparity_px * cross_steps);
    targets_.push_back(along_x ? cv::Point(displacement, across) : cv::Point(across, displacement));
  }
}

}  // namespace light_field_depth
