#include "core/cloud/batch_fusion.h"

#include <algorithm>

namespace light_field_depth::cloud
{
BatchFusion::BatchFusion(const LightField& light_field, const std::vector<ViewDisparity>& maps,
                         ThreadPool& pool)
    : light_field_(light_field), pool_(pool), tolerance_(toleranceFor(light_field, rangeOf(maps))),
      surfaces_(makeSurfaceMaps(light_field, maps, tolerance_, pool)),
      slots_(std::min(light_field.views.size(), static_cast<std::size_t>(pool.threads())))
{
}

void BatchFusion::run(float min_confidence, const ForView& for_view, const ForBatch& for_batch) const
{
  std::vector<FusionScratch> scratch(slots_);
  const std::size_t views = light_field_.views.size();
  for (std::size_t first = 0; first < views; first += slots_)
  {
    const std::size_t count = std::min(slots_, views - first);
    pool_.parallelFor(0, static_cast<int>(count), 1,
                      [&](int begin, int end)
                      {
                        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
                        {
                          const View& view = light_field_.views[first + i];
                          for_view(view, i,
                                   [&](const FusedRowSink& sink) {
                                     fuseView(surfaces_, view, tolerance_, min_confidence, scratch[i], sink);
                                   });
                        }
                      });
    for_batch(first, count);
  }
}

}  // namespace light_field_depth::cloud
