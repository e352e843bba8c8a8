#include "core/multiview/refine/view_rays.h"

#include <algorithm>
#include <numeric>

namespace light_field_depth::multiview
{
namespace
{
/// Views whose directions differ by less stand on one ray.
constexpr double SAME_DIRECTION = 1e-3;

SampledView sampledView(const PreparedView& view)
{
  SampledView sampled;
  const PlanarImage& image = view.image;
  sampled.pixels = image.row(0);
  sampled.channel_stride = image.channelStride();
  sampled.row_stride = static_cast<std::ptrdiff_t>(image.channelStride()) * image.channels();
  sampled.pad_before = image.pad();
  sampled.pad_after = static_cast<int>(image.channelStride()) - image.pad() - image.width();
  sampled.step_x = static_cast<float>(view.steps.x);
  sampled.step_y = static_cast<float>(view.steps.y);
  sampled.offset_x = static_cast<float>(view.offset_px.x);
  sampled.offset_y = static_cast<float>(view.offset_px.y);
  sampled.position = view.position;
  if (view.masked.width() > 0)
  {
    sampled.masked = view.masked.row(0);
    sampled.masked_stride = static_cast<std::ptrdiff_t>(view.masked.channelStride());
  }
  return sampled;
}

}  // namespace

ViewRays findViewRays(const ViewSet& views)
{
  ViewRays result;
  for (const Arm& arm : views.arms)
  {
    const int first_ray = static_cast<int>(result.rays.size());
    std::vector<int> left(static_cast<std::size_t>(arm.last - arm.first));
    std::iota(left.begin(), left.end(), arm.first);
    const auto direction = [&](int view)
    {
      const PreparedView& prepared = views.views[static_cast<std::size_t>(view)];
      return prepared.steps / static_cast<double>(prepared.position);
    };
    while (!left.empty())
    {
      const cv::Point2d along = direction(left.front());
      const auto rest =
          std::stable_partition(left.begin(), left.end(),
                                [&](int view) { return cv::norm(direction(view) - along) < SAME_DIRECTION; });
      const int first = static_cast<int>(result.views.size());
      std::for_each(left.begin(), rest,
                    [&](int view)
                    { result.views.push_back(sampledView(views.views[static_cast<std::size_t>(view)])); });
      result.rays.push_back({first, static_cast<int>(result.views.size())});
      result.directions.emplace_back(along);
      left.erase(left.begin(), rest);
    }
    result.of_arm.push_back({first_ray, static_cast<int>(result.rays.size())});
  }
  return result;
}

}  // namespace light_field_depth::multiview
