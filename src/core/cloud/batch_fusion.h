#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_BATCH_FUSION_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_BATCH_FUSION_H

#include <cstddef>
#include <functional>
#include <vector>

#include "core/cloud/surface_fusion.h"
#include "core/cloud/surface_map.h"
#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::cloud
{
/// Fuses maps for all views of a light field (fuseView()), a batch of them at a time, each on a thread.
class BatchFusion
{
public:
  /// Hands the rows of a view to a sink.
  using FusedRows = std::function<void(const FusedRowSink& sink)>;
  /// What is done with a view of the light field, on any thread. @param slot of the batch
  using ForView = std::function<void(const View& view, std::size_t slot, const FusedRows& rows)>;
  /// What is done with a batch, between batches: the views first .. first + count - 1 are in slots 0 .. count
  /// - 1.
  using ForBatch = std::function<void(std::size_t first, std::size_t count)>;

  BatchFusion(const LightField& light_field, const std::vector<ViewDisparity>& maps, ThreadPool& pool);

  std::size_t slots() const { return slots_; }

  void run(float min_confidence, const ForView& for_view, const ForBatch& for_batch) const;

private:
  const LightField& light_field_;
  ThreadPool& pool_;
  Tolerance tolerance_;
  std::vector<SurfaceMap> surfaces_;
  std::size_t slots_;
};

}  // namespace light_field_depth::cloud

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_BATCH_FUSION_H
